// One side of a benchmark, with rosnodejs: MODE modules=DIR messages=DIR name=value ...
//
// Publishers write in `publish` (throttleMs -1): the package's other way keeps one message
// and drops the rest. Nothing tells when a socket is full, so what is not sent yet is in
// memory, as with roscpp; the event loop goes around now and then, or it would all be.

"use strict";

const bench = require("./node_common.cjs");
const { options, number, namespace, TYPES } = bench;

process.env.CMAKE_PREFIX_PATH = options.messages;
const rosnodejs = bench.load("rosnodejs");

const BURST = number("size") >= bench.LARGE ? 1 : 100;
const DIRECT = { queueSize: 0, throttleMs: -1, tcpNoDelay: true };
const type = TYPES[options.kind ?? "String"];
const flip = `${namespace}/flip`;

async function start() {
  const quiet = { setLoggers: () => {}, skipRosLogging: true };
  return rosnodejs.initNode(`${namespace}/${bench.mode}`, { logging: quiet, notime: true });
}

const advertise = (node, name) => node.advertise(`${namespace}/${name}`, type, { ...DIRECT });
const subscribe = (node, name, callback) =>
  node.subscribe(`${namespace}/${name}`, type, callback, { ...DIRECT });

async function pub() {
  const node = await start();
  const message = bench.makeMessage({ secs: 0, nsecs: 0 });
  const publisher = advertise(node, "benchmark");
  await bench.until(() => publisher.getNumSubscribers() > 0);
  const used = bench.cpu();
  const begun = bench.now();
  const count = number("count");
  for (let i = 1; i <= count; ++i) {
    publisher.publish(message);
    if (i % BURST === 0) await new Promise(setImmediate);
  }
  // Most of it is still in memory: it is sent when the subscriber has it and leaves.
  await bench.until(() => publisher.getNumSubscribers() === 0);
  bench.report({ cpu: bench.cpu() - used, seconds: bench.now() - begun });
}

async function sub() {
  const node = await start();
  const state = bench.counter();
  subscribe(node, "benchmark", state.count);
  bench.report({ ready: 1 });
  await state.over;
  state.report();
}

async function ping() {
  const node = await start();
  const message = bench.makeMessage();
  const publisher = advertise(node, "ping");
  const pongs = bench.answers();
  const subscriber = subscribe(node, "pong", pongs.arrived);
  await bench.until(() => publisher.getNumSubscribers() && subscriber.getNumPublishers());
  await new Promise((resolve) => setTimeout(resolve, 200)); // the other side has to see it too
  const times = [];
  for (let i = Math.floor(number("count") * 1.1); i > 0; --i) {
    const begun = bench.now();
    const pong = pongs.next();
    publisher.publish(message);
    await pong;
    times.push(bench.now() - begun);
  }
  bench.reportTimes(times);
}

async function pong() {
  const node = await start();
  const publisher = advertise(node, "pong");
  subscribe(node, "ping", (message) => publisher.publish(message));
  await new Promise(() => {});
}

async function serve() {
  const node = await start();
  node.advertiseService(flip, "std_srvs/SetBool", (request, response) => {
    response.success = request.data;
    response.message = "ok";
    return true;
  });
  await new Promise(() => {});
}

async function call() {
  const node = await start();
  await node.waitForService(flip);
  const client = node.serviceClient(flip, "std_srvs/SetBool", {
    persist: options.persistent === "1",
  });
  const times = [];
  for (let i = Math.floor(number("count") * 1.1); i > 0; --i) {
    const begun = bench.now();
    const response = await client.call({ data: true });
    times.push(bench.now() - begun);
    if (!response.success) throw new Error("not the answer");
  }
  bench.reportTimes(times);
}

async function idle() {
  const node = await start();
  advertise(node, "out");
  subscribe(node, "in", () => {});
  bench.report({ ready: 1 });
  await new Promise(() => {});
}

const modes = { pub, sub, ping, pong, serve, call, idle };
modes[bench.mode]().then(
  () => process.exit(0),
  (error) => {
    console.error(error);
    process.exit(1);
  },
);
