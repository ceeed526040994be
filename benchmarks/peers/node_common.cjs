// What the peers in JavaScript share: options, messages, and what they measure and tell.

"use strict";

const fs = require("fs");
const { createRequire } = require("module");

const mode = process.argv[2];
const options = Object.fromEntries(process.argv.slice(3).map((word) => word.split(/=(.*)/s)));
const number = (name, otherwise = 0) => Number(options[name] ?? otherwise);
const namespace = process.env.ROS_NAMESPACE.replace(/\/$/, "");

const TYPES = {
  String: "std_msgs/String",
  JointState: "sensor_msgs/JointState",
  TransformStamped: "geometry_msgs/TransformStamped",
  PointCloud2: "sensor_msgs/PointCloud2",
  Image: "sensor_msgs/Image",
};
const IDLE = 3000; // ms without a message after which the rest is taken as lost
const LARGE = 1 << 16;

// `stamp` is what the library takes for a time.
function makeMessage(stamp) {
  const size = number("size");
  const header = (frame) => ({ seq: 0, stamp, frame_id: frame });
  const xyz = { x: 0, y: 0, z: 0 };
  switch (options.kind) {
    case "String":
      return { data: "x".repeat(size) };
    case "JointState":
      return {
        header: header("base_link"),
        name: Array.from({ length: 6 }, (_, i) => `joint_${i}`),
        position: new Array(6).fill(0.5),
        velocity: new Array(6).fill(0.5),
        effort: new Array(6).fill(0.5),
      };
    case "TransformStamped":
      return {
        header: header("odom"),
        child_frame_id: "base_link",
        transform: { translation: xyz, rotation: { ...xyz, w: 1 } },
      };
    case "PointCloud2":
      return {
        header: header("camera"),
        height: 0,
        width: 0,
        fields: [],
        is_bigendian: false,
        point_step: 0,
        row_step: 0,
        data: Buffer.alloc(size),
        is_dense: false,
      };
    default:
      return {
        header: header("camera"),
        height: 0,
        width: 0,
        encoding: "",
        is_bigendian: 0,
        step: 0,
        data: Buffer.alloc(size),
      };
  }
}

function cpu() {
  const used = process.cpuUsage();
  return (used.user + used.system) / 1e6;
}

const now = () => performance.now() / 1e3;
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

async function until(condition) {
  while (!condition()) await sleep(10);
}

function report(figures) {
  const peak = /^VmHWM:\s+(\d+)/m.exec(fs.readFileSync("/proc/self/status", "latin1"));
  if (peak) figures.rss = Number(peak[1]) * 1024;
  fs.writeSync(1, JSON.stringify(figures) + "\n");
}

function reportTimes(times) {
  const counted = times.slice(times.length - number("count"));
  const seconds = counted.reduce((sum, time) => sum + time, 0);
  counted.sort((a, b) => a - b);
  const at = (share) => counted[Math.floor(counted.length * share)] * 1e6;
  report({ count: counted.length, seconds, p50: at(0.5), p99: at(0.99) });
}

// Counts what comes; `over` resolves when it has, or when nothing has for some time.
function counter() {
  const state = { received: 0, first: 0, last: 0, used: 0 };
  let finish;
  state.over = new Promise((resolve) => (finish = resolve));
  const watch = setInterval(() => {
    if (state.received && performance.now() - state.last * 1e3 > IDLE) finish();
  }, 200);
  state.over.then(() => clearInterval(watch));
  state.count = () => {
    state.last = now();
    if (!state.received++) {
      state.first = state.last;
      state.used = cpu();
    }
    if (state.received === number("count")) finish();
  };
  state.report = () =>
    report({
      received: state.received,
      seconds: state.last - state.first,
      cpu: cpu() - state.used,
    });
  return state;
}

// Answers that come back: `next` resolves with the one that comes next.
function answers() {
  let wake;
  return {
    arrived: () => wake && wake(),
    next: () => new Promise((resolve) => (wake = resolve)),
  };
}

module.exports = {
  load: createRequire(`${options.modules}/peer.cjs`),
  ...{ mode, options, number, namespace, TYPES, LARGE, makeMessage },
  ...{ cpu, now, until, report, reportTimes, counter, answers },
};
