// One side of a benchmark, with roscpp: MODE name=value ..., as every peer here.
//
// All queues are unbounded (size 0): roscpp then loses nothing.

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <std_srvs/SetBool.h>

using Clock = std::chrono::steady_clock;

static const double kIdle = 3.0;  // seconds without a message: the rest is lost
static const char kTopic[] = "benchmark";
static std::map<std::string, std::string> options;

static long number(const char* name, long otherwise = 0) {
  auto found = options.find(name);
  return found == options.end() ? otherwise : std::atol(found->second.c_str());
}

static double since(Clock::time_point start, Clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}

static double cpu() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
         (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) / 1e6;
}

// The most memory there was, in bytes.
static long peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.compare(0, 6, "VmHWM:") == 0) return std::atol(line.c_str() + 6) * 1024;
  }
  return 0;
}

static void report_ready() {
  std::printf("{\"ready\": 1}\n");
  std::fflush(stdout);
}

static void report_times(std::vector<double> times, long warm_up, long failed = 0) {
  times.erase(times.begin(), times.begin() + warm_up);
  std::sort(times.begin(), times.end());
  double sum = 0;
  for (double time : times) sum += time;
  const double p50 = times[times.size() / 2], p99 = times[times.size() * 99 / 100];
  std::printf("{\"count\": %zu, \"seconds\": %.9f, \"p50\": %.3f, \"p99\": %.3f, ", times.size(), sum,
              p50 * 1e6, p99 * 1e6);
  std::printf("\"failed\": %ld}\n", failed);
  std::fflush(stdout);
}

static void fill(std_msgs::String& message) { message.data.assign(number("size"), 'x'); }

static void fill(sensor_msgs::JointState& message) {
  message.header.frame_id = "base_link";
  for (int i = 0; i < 6; ++i) message.name.push_back("joint_" + std::to_string(i));
  message.position.assign(6, 0.5);
  message.velocity.assign(6, 0.5);
  message.effort.assign(6, 0.5);
}

static void fill(geometry_msgs::TransformStamped& message) {
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.transform.rotation.w = 1.0;
}

template <class Message>
static void fill(Message& message) {
  message.header.frame_id = "camera";
  message.data.resize(number("size"));
}

// The topic, so many times; or those that topics=N asks for.
static std::vector<std::string> topics(long times = 1) {
  const long many = number("topics");
  if (!many) return std::vector<std::string>(times, kTopic);
  std::vector<std::string> names;
  for (long i = 0; i < many; ++i) names.push_back(std::string(kTopic) + "_" + std::to_string(i));
  return names;
}

template <class Message>
static void pub(ros::NodeHandle& node) {
  ros::AsyncSpinner spinner(1);
  spinner.start();
  Message message;
  fill(message);
  const Clock::time_point opened = Clock::now();
  std::vector<ros::Publisher> pubs;
  for (const std::string& topic : topics()) pubs.push_back(node.advertise<Message>(topic, 0));
  const double setup = since(opened, Clock::now());
  const long count = number("count"), rate = number("rate");
  for (const ros::Publisher& pub : pubs) {
    while (long(pub.getNumSubscribers()) < number("links", 1)) ros::WallDuration(0.01).sleep();
  }
  const double used = cpu();
  const Clock::time_point start = Clock::now();
  if (rate) {
    ros::WallRate pace(rate);
    for (long i = 0; i < count; ++i) {
      pubs[0].publish(message);
      pace.sleep();
    }
  } else {
    for (long i = 0; i < count; ++i) {
      for (const ros::Publisher& pub : pubs) pub.publish(message);
    }
  }
  // Most of it is still in the queue: it is sent when the subscriber has it and leaves.
  for (const ros::Publisher& pub : pubs) {
    while (pub.getNumSubscribers()) ros::WallDuration(0.01).sleep();
  }
  std::printf("{\"cpu\": %.6f, \"seconds\": %.9f, \"rss\": %ld, \"setup\": %.6f}\n", cpu() - used,
              since(start, Clock::now()), peak_memory(), setup);
}

template <class Message>
static void sub(ros::NodeHandle& node) {
  const std::vector<std::string> names = topics(number("subscribers", 1));
  const long total = number("count") * long(names.size());
  long received = 0;
  double used = 0;
  Clock::time_point first, last;
  boost::function<void(const boost::shared_ptr<Message const>&)> callback =
      [&](const boost::shared_ptr<Message const>&) {
        last = Clock::now();
        if (!received++) {
          first = last;
          used = cpu();
        }
      };
  const Clock::time_point opened = Clock::now();
  std::vector<ros::Subscriber> subs;
  for (const std::string& topic : names) {
    subs.push_back(node.subscribe<Message>(topic, 0, callback));
  }
  const double setup = since(opened, Clock::now());
  report_ready();
  while (received < total) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    if (received && since(last, Clock::now()) > kIdle) break;
  }
  std::printf("{\"received\": %ld, \"seconds\": %.9f, \"cpu\": %.6f, \"rss\": %ld, ", received,
              since(first, last), cpu() - used, peak_memory());
  std::printf("\"setup\": %.6f}\n", setup);
  std::fflush(stdout);
}

static void ping(ros::NodeHandle& node) {
  const long count = number("count"), warm_up = count / 10;
  std::vector<double> times;
  Clock::time_point start;
  std_msgs::String message;
  fill(message);
  ros::Publisher pub = node.advertise<std_msgs::String>("ping", 0);
  boost::function<void(const std_msgs::StringConstPtr&)> callback =
      [&](const std_msgs::StringConstPtr&) {
        times.push_back(since(start, Clock::now()));
        if (long(times.size()) == count + warm_up) return;
        start = Clock::now();
        pub.publish(message);
      };
  ros::Subscriber sub = node.subscribe<std_msgs::String>(
      "pong", 0, callback, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  while (!pub.getNumSubscribers() || !sub.getNumPublishers()) ros::WallDuration(0.01).sleep();
  ros::WallDuration(0.2).sleep();  // so that the other side has seen both connections as well
  start = Clock::now();
  pub.publish(message);
  while (long(times.size()) < count + warm_up) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  }
  report_times(times, warm_up);
}

static void pong(ros::NodeHandle& node) {
  ros::Publisher pub = node.advertise<std_msgs::String>("pong", 0);
  boost::function<void(const std_msgs::StringConstPtr&)> callback =
      [&](const std_msgs::StringConstPtr& message) { pub.publish(message); };
  ros::Subscriber sub = node.subscribe<std_msgs::String>(
      "ping", 0, callback, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  ros::spin();
}

static bool flip(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  response.success = request.data;
  response.message = "ok";
  return true;
}

static void serve(ros::NodeHandle& node) {
  ros::ServiceServer server = node.advertiseService("flip", flip);
  ros::spin();
}

static void call(ros::NodeHandle& node) {
  const long count = number("count"), warm_up = count / 10;
  long failed = 0;  // one of some hundreds does, with a connection for each
  std::vector<double> times;
  ros::service::waitForService("flip");
  ros::ServiceClient client =
      node.serviceClient<std_srvs::SetBool>("flip", number("persistent") != 0);
  std_srvs::SetBool service;
  service.request.data = true;
  for (long i = 0; i < count + warm_up; ++i) {
    const Clock::time_point start = Clock::now();
    if (client.call(service)) {
      times.push_back(since(start, Clock::now()));
    } else {
      ++failed;
    }
  }
  report_times(times, warm_up, failed);
}

static void ignore(const std_msgs::StringConstPtr&) {}

static void idle(ros::NodeHandle& node) {
  ros::Publisher pub = node.advertise<std_msgs::String>("out", 10);
  ros::Subscriber sub = node.subscribe("in", 10, ignore);
  report_ready();
  ros::spin();
}

// There for others to connect to; a message now and then shows which are gone.
static void host(ros::NodeHandle& node) {
  std::signal(SIGUSR1, [](int) { report_ready(); });
  ros::ServiceServer server = node.advertiseService("flip", flip);
  ros::Publisher pub = node.advertise<std_msgs::String>(kTopic, 0);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  report_ready();
  std_msgs::String message;
  message.data = "x";
  for (;;) {
    pub.publish(message);
    ros::WallDuration(0.1).sleep();
  }
}

template <class Message>
static void topic(ros::NodeHandle& node, const std::string& mode) {
  if (mode == "pub") pub<Message>(node);
  if (mode == "sub") sub<Message>(node);
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string mode = argv[1];
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t sign = word.find('=');
    if (sign != std::string::npos) options[word.substr(0, sign)] = word.substr(sign + 1);
  }
  ros::init(argc, argv, mode, ros::init_options::NoSigintHandler);
  ros::NodeHandle node;
  const std::string kind = options["kind"];
  if (mode == "ping") ping(node);
  else if (mode == "pong") pong(node);
  else if (mode == "serve") serve(node);
  else if (mode == "call") call(node);
  else if (mode == "idle") idle(node);
  else if (mode == "host") host(node);
  else if (kind == "String") topic<std_msgs::String>(node, mode);
  else if (kind == "JointState") topic<sensor_msgs::JointState>(node, mode);
  else if (kind == "TransformStamped") topic<geometry_msgs::TransformStamped>(node, mode);
  else if (kind == "PointCloud2") topic<sensor_msgs::PointCloud2>(node, mode);
  else if (kind == "Image") topic<sensor_msgs::Image>(node, mode);
  return 0;
}
