// Makes the classes of the packages in ROS_PACKAGE_PATH, as a catkin build would do it:
// rosnodejs_messages.cjs MODULES; they go to the folder CMAKE_PREFIX_PATH.

"use strict";

const { createRequire } = require("module");

const rosnodejs = createRequire(`${process.argv[2]}/peer.cjs`)("rosnodejs");
rosnodejs.loadAllPackages();
