// One side of a benchmark, with @foxglove/ros1: MODE modules=DIR definitions=FILE name=value ...
//
// `publish` resolves when the bytes have been handed to the system. A window of messages is
// kept under way: waiting for each would be slower by far, and for none of them would fill
// the memory. The package has no services.

"use strict";

const fs = require("fs");
const bench = require("./node_common.cjs");
const { options, number, namespace, TYPES } = bench;

const { RosNode } = bench.load("@foxglove/ros1");
const { TcpServerNode, TcpSocketNode } = bench.load("@foxglove/ros1/nodejs");
const { HttpServerNodejs } = bench.load("@foxglove/xmlrpc/nodejs");

const WINDOW = number("size") >= bench.LARGE ? 2 : 1000;
const definitions = JSON.parse(fs.readFileSync(options.definitions, "utf8"));
const dataType = TYPES[options.kind ?? "String"];

async function start() {
  const node = new RosNode({
    name: `${namespace}/${bench.mode}`,
    rosMasterUri: process.env.ROS_MASTER_URI,
    hostname: "localhost",
    pid: process.pid,
    httpServer: new HttpServerNodejs(),
    tcpSocketCreate: TcpSocketNode.Create,
    tcpServer: await TcpServerNode.Listen({ host: "0.0.0.0" }),
  });
  await node.start();
  return node;
}

const advertise = (node, name) =>
  node.advertise({
    topic: `${namespace}/${name}`,
    dataType,
    messageDefinitionText: definitions[dataType],
  });
const subscribe = (node, name) =>
  node.subscribe({ topic: `${namespace}/${name}`, dataType, tcpNoDelay: true });

async function pub() {
  const message = bench.makeMessage({ sec: 0, nsec: 0 });
  const node = await start();
  const publication = await advertise(node, "benchmark");
  await bench.until(() => publication.subscribers().size > 0);
  const used = bench.cpu();
  const begun = bench.now();
  let pending = [];
  for (let i = number("count"); i > 0; --i) {
    pending.push(node.publish(publication.name, message));
    if (pending.length === WINDOW) {
      await Promise.all(pending);
      pending = [];
    }
  }
  await Promise.all(pending);
  const figures = { cpu: bench.cpu() - used, seconds: bench.now() - begun };
  await bench.until(() => publication.subscribers().size === 0);
  bench.report(figures);
}

async function sub() {
  const node = await start();
  const state = bench.counter();
  subscribe(node, "benchmark").on("message", state.count);
  bench.report({ ready: 1 });
  await state.over;
  state.report();
}

async function ping() {
  const message = bench.makeMessage();
  const node = await start();
  const publication = await advertise(node, "ping");
  const subscription = subscribe(node, "pong");
  const pongs = bench.answers();
  subscription.on("message", pongs.arrived);
  await bench.until(() => publication.subscribers().size && subscription.publishers().size);
  await new Promise((resolve) => setTimeout(resolve, 200)); // the other side has to see it too
  const times = [];
  for (let i = Math.floor(number("count") * 1.1); i > 0; --i) {
    const begun = bench.now();
    const pong = pongs.next();
    void node.publish(publication.name, message);
    await pong;
    times.push(bench.now() - begun);
  }
  bench.reportTimes(times);
}

async function pong() {
  const node = await start();
  const publication = await advertise(node, "pong");
  subscribe(node, "ping").on("message", (message) => void node.publish(publication.name, message));
  await new Promise(() => {});
}

async function idle() {
  const node = await start();
  await advertise(node, "out");
  subscribe(node, "in");
  bench.report({ ready: 1 });
  await new Promise(() => {});
}

const modes = { pub, sub, ping, pong, idle };
modes[bench.mode]().then(
  () => process.exit(0),
  (error) => {
    console.error(error);
    process.exit(1);
  },
);
