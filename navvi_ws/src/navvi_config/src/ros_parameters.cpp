#include "navvi_config/ros_parameters.hpp"

#include <XmlRpcValue.h>
#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>

namespace navvi_config {
namespace {

constexpr rlim_t kFiles = 256;
constexpr rlim_t kMemory = rlim_t{4} << 30U;  // bytes

std::atomic<bool> g_name_taken{false}, g_asked{false};
volatile std::sig_atomic_t g_ending = 0;

YAML::Node to_yaml(XmlRpc::XmlRpcValue& value) {
  YAML::Node node;
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(static_cast<double>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpc::XmlRpcValue::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) node.push_back(to_yaml(value[i]));
      return node;
    case XmlRpc::XmlRpcValue::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& [key, item] : value) node[key] = to_yaml(item);
      return node;
    default:
      return node;
  }
}

}  // namespace

void allow_files() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= kFiles) return;
  const rlim_t allowed = limit.rlim_cur;
  limit.rlim_cur = std::min(limit.rlim_max, kFiles);
  if (limit.rlim_max >= kFiles && ::setrlimit(RLIMIT_NOFILE, &limit) == 0) return;
  throw ConfigError("Only " + std::to_string(allowed) + " files may be open at once; allowed is " +
                    std::to_string(kFiles) + " or more, such as by \"ulimit -n 1024\".");
}

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= kMemory) return;
  limit.rlim_cur = kMemory;
  ::setrlimit(RLIMIT_DATA, &limit);
#endif
}

void ask_for_priority(int niceness) {
  if (::setpriority(PRIO_PROCESS, 0, niceness) != 0) return;
  // Where the kernel shares the processor among sessions, a niceness counts inside of one only;
  // roslaunch gives each node a session of its own, and this is that session's.
  std::ofstream("/proc/self/autogroup") << niceness;
}

void init(int& argc, char** argv, const std::string& name) {
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    if (std::signal(signal, [](int) { end(); }) == SIG_IGN && signal == SIGHUP)
      std::signal(signal, SIG_IGN);  // by nohup
  std::signal(SIGCHLD, SIG_DFL);     // where it was ignored, no child could be waited for
}

bool await_master() {
  if (!ros::master::check())
    ROS_WARN("Waiting for the ROS master at %s.", ros::master::getURI().c_str());
  while (!ending() && !ros::master::check()) ros::WallDuration(0.2).sleep();
  return !ending();
}

void await_readers(const ros::Publisher& topic) {
  constexpr double kMost = 0.5, kLook = 0.01;  // s
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) return;
  std::uint32_t readers = 0;
  for (int i = 0; i < state[1].size(); ++i)
    if (std::string(state[1][i][0]) == topic.getTopic())
      readers = static_cast<std::uint32_t>(state[1][i][1].size());
  for (double waited = 0.0; waited < kMost && topic.getNumSubscribers() < readers; waited += kLook)
    ros::WallDuration(kLook).sleep();
}

void end() { g_ending = 1; }
bool ending() { return g_ending != 0; }

void spin() {
  while (ros::ok() && !ending())
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
}

void flush() { ros::WallDuration(0.05).sleep(); }

void end_on_request() {
  // What the first line to /rosout asks the master for. Asked there for the first time by a node
  // whose name was taken, it would register that node again, and end the other one.
  bool unused = false;
  ros::param::getCached("/rosout_disable_topics_generation", unused);
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind(
      "shutdown", [](XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& answer) {
        const std::string why = request.size() > 1 ? std::string(request[1]) : "";
        if (why.find("new node registered with same name") != why.npos &&
            !g_name_taken.exchange(true))
          ROS_FATAL("Another node has taken the name %s, so this one ends.",
                    ros::this_node::getName().c_str());
        g_asked = true;
        end();
        answer = ros::xmlrpc::responseInt(1, "", 0);
      });
}

bool name_is_taken() { return g_name_taken; }

bool ends_alone() { return g_asked; }

int reject(const std::string& error) {
  const pid_t launcher = is_roslaunch(::getppid()) ? ::getppid() : 0;
  ROS_FATAL("%s%s", error.c_str(), launcher != 0 ? " It is rejected, so the session ends." : "");
  // Not at once: a node that roslaunch starts just now can lose its signal.
  while (launcher != 0 && !ending()) {
    ros::WallDuration(1.0).sleep();
    if (::kill(launcher, SIGINT) != 0) break;
  }
  return 2;
}

YAML::Node parameters(const ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue value;
  if (!node.getParam(node.getNamespace(), value)) return YAML::Node(YAML::NodeType::Map);
  return to_yaml(value);
}

}  // namespace navvi_config
