// One side of the topic benchmark, with roscpp: "pub" or "sub", count, size.
//
// Both queues are unbounded (size 0): roscpp then loses nothing.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

using Clock = std::chrono::steady_clock;

static const double kIdle = 3.0;  // seconds without a message: the rest is lost

static double since(Clock::time_point start, Clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}

static void publish(ros::NodeHandle& node, long count, long size) {
  ros::Publisher pub = node.advertise<std_msgs::String>("benchmark", 0);
  while (!pub.getNumSubscribers()) ros::WallDuration(0.01).sleep();
  std_msgs::String message;
  message.data.assign(size, 'x');
  for (long i = 0; i < count; ++i) pub.publish(message);
  while (pub.getNumSubscribers()) ros::WallDuration(0.01).sleep();
}

static void subscribe(ros::NodeHandle& node, long count) {
  long received = 0;
  Clock::time_point first, last;
  boost::function<void(const std_msgs::StringConstPtr&)> callback =
      [&](const std_msgs::StringConstPtr&) {
        last = Clock::now();
        if (!received++) first = last;
      };
  ros::Subscriber sub = node.subscribe<std_msgs::String>("benchmark", 0, callback);
  while (received < count) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    if (received && since(last, Clock::now()) > kIdle) break;
  }
  std::printf("{\"received\": %ld, \"seconds\": %.9f}\n", received, since(first, last));
  std::fflush(stdout);
}

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::string role = argv[1];
  ros::init(argc, argv, "bench_" + role, ros::init_options::NoSigintHandler);
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  if (role == "pub") {
    spinner.start();
    publish(node, std::atol(argv[2]), std::atol(argv[3]));
  } else {
    subscribe(node, std::atol(argv[2]));
  }
  return 0;
}
