// A roscpp node whose first argument says what it is to be. It tells what happens to
// it in JSON, one object a line.

#include <cstdio>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>
#include <std_srvs/SetBool.h>

namespace
{

using Args = std::vector<std::string>;

std::string in_quotes(const std::string& text)
{
  std::ostringstream out;
  out << '"';
  for (unsigned char c : text)
  {
    if (c == '"' || c == '\\')
    {
      out << '\\' << c;
    }
    else if (c < 0x20 || c > 0x7e)
    {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", c);
      out << escape;
    }
    else
    {
      out << c;
    }
  }
  out << '"';
  return out.str();
}

void say(const std::string& key, const std::string& json)
{
  std::cout << '{' << in_quotes(key) << ": " << json << '}' << std::endl;
}

template <class Sequence, class Show>
std::string listed(const Sequence& sequence, Show show)
{
  std::ostringstream out;
  out << '[';
  bool first = true;
  for (const auto& item : sequence)
  {
    out << (first ? "" : ", ") << show(item);
    first = false;
  }
  out << ']';
  return out.str();
}

std::string number(double value)
{
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

std::string shown(const std_msgs::Header& header)
{
  std::ostringstream out;
  out << "{\"seq\": " << header.seq << ", \"frame_id\": " << in_quotes(header.frame_id)
      << ", \"stamp\": [" << header.stamp.sec << ", " << header.stamp.nsec << "]}";
  return out.str();
}

// Each type: message number i, and a message as JSON.

void fill(std_msgs::String& message, int i)
{
  message.data = "number " + std::to_string(i);
}

std::string shown(const std_msgs::String& message)
{
  return "{\"data\": " + in_quotes(message.data) + "}";
}

void fill(std_msgs::Int32& message, int i)
{
  message.data = i;
}

std::string shown(const std_msgs::Int32& message)
{
  return "{\"data\": " + std::to_string(message.data) + "}";
}

void fill(std_msgs::Empty&, int)
{
}

std::string shown(const std_msgs::Empty&)
{
  return "{}";
}

void fill(sensor_msgs::JointState& message, int i)
{
  message.header.frame_id = "arm";
  message.header.stamp = ros::Time(1000 + i, 500);
  message.name = {"shoulder", "elbow"};
  message.position = {0.5 * i, -1.25};
  message.velocity = {1e-3};
}

std::string shown(const sensor_msgs::JointState& message)
{
  std::ostringstream out;
  out << "{\"header\": " << shown(message.header)
      << ", \"name\": " << listed(message.name, in_quotes)
      << ", \"position\": " << listed(message.position, number)
      << ", \"velocity\": " << listed(message.velocity, number)
      << ", \"effort\": " << listed(message.effort, number) << "}";
  return out.str();
}

void fill(sensor_msgs::Image& message, int i)
{
  message.header.frame_id = "camera";
  message.height = 1024;
  message.width = 1024;
  message.step = 1024;
  message.encoding = "mono8";
  message.data.resize(1024 * 1024);
  for (std::size_t k = 0; k < message.data.size(); ++k)
  {
    message.data[k] = static_cast<unsigned char>((k + i) % 251);
  }
}

std::string shown(const sensor_msgs::Image& message)
{
  unsigned long sum = 0;
  for (unsigned char byte : message.data)
  {
    sum += byte;
  }
  std::ostringstream out;
  out << "{\"header\": " << shown(message.header) << ", \"height\": " << message.height
      << ", \"width\": " << message.width << ", \"encoding\": " << in_quotes(message.encoding)
      << ", \"length\": " << message.data.size() << ", \"sum\": " << sum << "}";
  return out.str();
}

void fill(nav_msgs::Path& message, int i)
{
  message.header.frame_id = "map";
  message.poses.resize(3);
  for (std::size_t k = 0; k < message.poses.size(); ++k)
  {
    message.poses[k].header.frame_id = "pose" + std::to_string(k);
    message.poses[k].pose.position.x = i + 0.5 * k;
    message.poses[k].pose.orientation.w = 1.0;
  }
}

std::string shown(const geometry_msgs::PoseStamped& message)
{
  return "{\"frame_id\": " + in_quotes(message.header.frame_id) +
         ", \"x\": " + number(message.pose.position.x) +
         ", \"w\": " + number(message.pose.orientation.w) + "}";
}

std::string shown(const nav_msgs::Path& message)
{
  return "{\"header\": " + shown(message.header) + ", \"poses\": " +
         listed(message.poses, [](const geometry_msgs::PoseStamped& p) { return shown(p); }) + "}";
}

void fill(sensor_msgs::PointCloud& message, int i)
{
  message.header.frame_id = "laser";
  message.points.resize(3);
  message.points[1].x = i + 0.5;
  message.channels.resize(2);
  message.channels[0].name = "intensity";
  message.channels[1].values = {0.25, static_cast<float>(i)};
}

std::string shown(const geometry_msgs::Point32& point)
{
  return "[" + number(point.x) + ", " + number(point.y) + ", " + number(point.z) + "]";
}

std::string shown(const sensor_msgs::ChannelFloat32& channel)
{
  return "{\"name\": " + in_quotes(channel.name) +
         ", \"values\": " + listed(channel.values, number) + "}";
}

std::string shown(const sensor_msgs::PointCloud& message)
{
  return "{\"header\": " + shown(message.header) + ", \"points\": " +
         listed(message.points, [](const geometry_msgs::Point32& p) { return shown(p); }) +
         ", \"channels\": " +
         listed(message.channels, [](const sensor_msgs::ChannelFloat32& c) { return shown(c); }) +
         "}";
}

std::string shown(const sensor_msgs::CameraInfo& info)
{
  return "{\"frame_id\": " + in_quotes(info.header.frame_id) + ", \"D\": " +
         listed(info.D, number) + ", \"K\": " + listed(info.K, number) +
         ", \"width\": " + std::to_string(info.roi.width) + "}";
}

// talker TOPIC TYPE COUNT RATE LATCH: waits for a subscriber unless it latches.

template <class Message>
int talk(ros::NodeHandle& handle, const Args& args)
{
  const bool latch = args.at(4) == "1";
  const int count = std::stoi(args.at(2));
  ros::Publisher publisher = handle.advertise<Message>(
      args.at(0), 100,
      [](const ros::SingleSubscriberPublisher& to)
      { say("subscriber", in_quotes(to.getSubscriberName())); },
      [](const ros::SingleSubscriberPublisher& to)
      { say("gone", in_quotes(to.getSubscriberName())); },
      ros::VoidConstPtr(), latch);
  say("ready", "true");
  ros::WallRate rate(std::stod(args.at(3)));
  for (int i = 0; ros::ok();)
  {
    ros::spinOnce();
    if ((latch || publisher.getNumSubscribers() > 0) && (count == 0 || i < count))
    {
      Message message;
      fill(message, i++);
      publisher.publish(message);
    }
    rate.sleep();
  }
  return 0;
}

// listener TOPIC TYPE

template <class Message>
int listen(ros::NodeHandle& handle, const Args& args)
{
  boost::function<void(const ros::MessageEvent<Message const>&)> heard =
      [](const ros::MessageEvent<Message const>& event)
  {
    say("message", shown(*event.getMessage()));
    const auto header = event.getConnectionHeader();
    const auto latching = header.find("latching");
    say("from", in_quotes(event.getPublisherName()));
    say("latching", in_quotes(latching == header.end() ? "" : latching->second));
  };
  ros::Subscriber subscriber = handle.subscribe<Message>(args.at(0), 100, heard);
  say("ready", "true");
  ros::spin();
  return 0;
}

// latches TOPIC COUNT: that many latched publishers of one topic in this node.

int latch_many(ros::NodeHandle& handle, const Args& args)
{
  std::vector<ros::Publisher> publishers;
  for (int i = 0; i < std::stoi(args.at(1)); ++i)
  {
    publishers.push_back(handle.advertise<std_msgs::String>(args.at(0), 10, true));
    std_msgs::String message;
    fill(message, i);
    publishers.back().publish(message);
  }
  say("ready", "true");
  ros::spin();
  return 0;
}

// server NAME [FAIL]: SetBool; with FAIL, data=false throws it ("false" returns false).

int serve(ros::NodeHandle& handle, const Args& args)
{
  const std::string fail = args.size() > 1 ? args[1] : "";
  boost::function<bool(std_srvs::SetBool::Request&, std_srvs::SetBool::Response&)> answer =
      [fail](std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response)
  {
    say("request", request.data ? "true" : "false");
    if (!request.data && !fail.empty())
    {
      if (fail == "false")
      {
        return false;
      }
      throw std::runtime_error(fail);
    }
    response.success = request.data;
    response.message = request.data ? "it is on" : "it is off";
    return true;
  };
  ros::ServiceServer server = handle.advertiseService(args.at(0), answer);
  say("ready", "true");
  ros::spin();
  return 0;
}

// camera_server NAME: SetCameraInfo, answered with what it was asked.

int serve_camera(ros::NodeHandle& handle, const Args& args)
{
  boost::function<bool(sensor_msgs::SetCameraInfo::Request&, sensor_msgs::SetCameraInfo::Response&)>
      answer = [](sensor_msgs::SetCameraInfo::Request& request,
                  sensor_msgs::SetCameraInfo::Response& response)
  {
    response.success = request.camera_info.roi.do_rectify;
    response.status_message = shown(request.camera_info);
    return true;
  };
  ros::ServiceServer server = handle.advertiseService(args.at(0), answer);
  say("ready", "true");
  ros::spin();
  return 0;
}

// client NAME COUNT PERSISTENT: request i asks with data = (i is even).

int call(ros::NodeHandle& handle, const Args& args)
{
  ros::service::waitForService(args.at(0), 10000);
  ros::ServiceClient client =
      handle.serviceClient<std_srvs::SetBool>(args.at(0), args.at(2) == "1");
  for (int i = 0; i < std::stoi(args.at(1)); ++i)
  {
    std_srvs::SetBool service;
    service.request.data = i % 2 == 0;
    if (client.call(service))
    {
      std::ostringstream out;
      out << "{\"success\": " << (service.response.success ? "true" : "false")
          << ", \"message\": " << in_quotes(service.response.message) << "}";
      say("answer", out.str());
    }
    else
    {
      say("failed", client.isValid() ? "\"valid\"" : "\"invalid\"");
    }
  }
  say("done", "true");
  return 0;
}

// camera_client NAME

int call_camera(ros::NodeHandle& handle, const Args& args)
{
  ros::service::waitForService(args.at(0), 10000);
  sensor_msgs::SetCameraInfo service;
  sensor_msgs::CameraInfo& info = service.request.camera_info;
  info.header.frame_id = "lens";
  info.D = {0.5, -0.25};
  info.K[8] = 1.0;
  info.roi.width = 640;
  if (ros::service::call(handle.resolveName(args.at(0)), service))
  {
    say("status", in_quotes(service.response.status_message));
  }
  else
  {
    say("failed", "true");
  }
  return 0;
}

// params BASE: one of each operation below BASE.

int use_params(ros::NodeHandle& handle, const Args& args)
{
  const std::string base = args.at(0);
  int integer = 0;
  double real = 0;
  bool flag = false;
  std::string text, found;
  std::vector<std::string> names;
  std::map<std::string, int> table;
  say("int", handle.getParam(base + "/int", integer) ? std::to_string(integer) : "null");
  say("float", handle.getParam(base + "/float", real) ? number(real) : "null");
  say("bool", handle.getParam(base + "/bool", flag) ? (flag ? "true" : "false") : "null");
  say("text", handle.getParam(base + "/text", text) ? in_quotes(text) : "null");
  say("list", handle.getParam(base + "/list", names) ? listed(names, in_quotes) : "null");
  say("table", handle.getParam(base + "/table", table) ? std::to_string(table["one"]) : "null");
  say("missing", handle.getParam(base + "/missing", integer) ? "true" : "false");
  handle.setParam(base + "/from_cpp", std::map<std::string, double>{{"x", 1.5}, {"y", -2.0}});
  handle.setParam(base + "/names", std::vector<std::string>{"a", "b"});
  say("has", handle.hasParam(base + "/names") ? "true" : "false");
  say("deleted", handle.deleteParam(base + "/text") ? "true" : "false");
  const bool searched = ros::NodeHandle(base + "/table").searchParam("int", found);
  say("search", searched ? in_quotes(found) : "null");
  say("done", "true");
  return 0;
}

// param_watch KEY: says each new value that the cache of the process has.

int watch_param(ros::NodeHandle& handle, const Args& args)
{
  int last = -1;
  say("ready", "true");
  for (ros::WallRate rate(100); ros::ok(); rate.sleep())
  {
    int value = -2;
    handle.getParamCached(args.at(0), value);
    if (value != last)
    {
      say("value", std::to_string(value));
      last = value;
    }
    ros::spinOnce();
  }
  return 0;
}

// param_setter: does what it reads, a word on a line each: set KEY NUMBER, table KEY NUMBER NAME...,
// text KEY TEXT (\\r is a carriage return), get KEY, delete KEY.

int set_params(ros::NodeHandle&, const Args&)
{
  say("ready", "true");
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream words(line);
    std::string what, key, text;
    int number = 0;
    words >> what >> key;
    if (what == "set" && words >> number)
    {
      ros::param::set(key, number);
    }
    else if (what == "table" && words >> number)
    {
      std::map<std::string, int> table;
      for (std::string name; words >> name;)
      {
        table[name] = number;
      }
      ros::param::set(key, table);
    }
    else if (what == "text")
    {
      words.get();
      std::getline(words, text);
      for (size_t at; (at = text.find("\\r")) != std::string::npos;)
      {
        text.replace(at, 2, "\r");
      }
      ros::param::set(key, text);
    }
    else if (what == "get")
    {
      say("result", ros::param::get(key, text) ? in_quotes(text) : "null");
      continue;
    }
    else if (what == "delete")
    {
      ros::param::del(key);
    }
    say("result", "true");
  }
  return 0;
}

using Role = int (*)(ros::NodeHandle&, const Args&);

const std::map<std::string, Role> roles = {
    {"latches", latch_many},
    {"server", serve},
    {"camera_server", serve_camera},
    {"client", call},
    {"camera_client", call_camera},
    {"params", use_params},
    {"param_watch", watch_param},
    {"param_setter", set_params},
    {"talker std_msgs/String", talk<std_msgs::String>},
    {"talker std_msgs/Int32", talk<std_msgs::Int32>},
    {"talker std_msgs/Empty", talk<std_msgs::Empty>},
    {"talker sensor_msgs/JointState", talk<sensor_msgs::JointState>},
    {"talker sensor_msgs/Image", talk<sensor_msgs::Image>},
    {"talker sensor_msgs/PointCloud", talk<sensor_msgs::PointCloud>},
    {"talker nav_msgs/Path", talk<nav_msgs::Path>},
    {"listener std_msgs/String", listen<std_msgs::String>},
    {"listener std_msgs/Int32", listen<std_msgs::Int32>},
    {"listener std_msgs/Empty", listen<std_msgs::Empty>},
    {"listener sensor_msgs/JointState", listen<sensor_msgs::JointState>},
    {"listener sensor_msgs/Image", listen<sensor_msgs::Image>},
    {"listener sensor_msgs/PointCloud", listen<sensor_msgs::PointCloud>},
    {"listener nav_msgs/Path", listen<nav_msgs::Path>},
};

}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "roscpp_peer");
  if (argc < 2)
  {
    return 2;
  }
  std::string role = argv[1];
  const Args args(argv + 2, argv + argc);
  if (role == "talker" || role == "listener")
  {
    role += " " + args.at(1);
  }
  ros::NodeHandle handle;
  return roles.at(role)(handle, args);
}
