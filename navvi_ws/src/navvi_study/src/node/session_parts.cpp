#include "node/session_parts.hpp"

#include <netdb.h>
#include <poll.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <navvi_config/launcher.hpp>
#include <navvi_config/ros_parameters.hpp>
#include <thread>
#include <utility>

namespace navvi_study::node {
namespace {

constexpr int kPatience = 300;              // ms
constexpr int kLook = 10;                   // ms between two looks
constexpr int kThreads = 100;               // ms that roslaunch's threads take to end, one by one
constexpr int kBusy = 800;                  // ms that they take longer on a busy machine
constexpr int kWatch = 1000;                // ms between two looks at the master

/// The host says that nobody listens there. One that is only slow does not say so.
bool nobody_listens(const std::string& host, std::uint32_t port) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return false;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> address(found, &::freeaddrinfo);
  const int link = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  if (link < 0) return false;
  int error = ::connect(link, address->ai_addr, address->ai_addrlen) == 0 ? 0 : errno;
  pollfd waits{link, POLLOUT, 0};
  if (error == EINPROGRESS && ::poll(&waits, 1, kPatience) == 1) {
    socklen_t size = sizeof(error);
    ::getsockopt(link, SOL_SOCKET, SO_ERROR, &error, &size);
  }
  ::close(link);
  return error == ECONNREFUSED;
}

constexpr std::pair<const char*, const char*> kParts[] = {{"/sim_node", "simulator_lost"},
                                                          {"/perception_node", "perception_lost"},
                                                          {"/relay_node", "relay_lost"}};

/// Of a node, as its URI; empty: it is not registered.
std::string address_of(const std::string& node) {
  XmlRpc::XmlRpcValue request, response, address;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, address, false)) return {};
  return address;
}

/// The signal may come when the first of roslaunch's threads has ended, and the last has not yet.
bool launcher_has_ended(int patience) {  // ms
  for (int waited = 0; waited < patience; waited += kLook) {
    if (navvi_config::parent_has_ended()) return true;
    ::poll(nullptr, 0, kLook);
  }
  return false;
}

}  // namespace

void end_with_master() {
  std::thread([host = ros::master::getHost(), port = ros::master::getPort()] {
    for (int lost = 0; lost < 2; lost = nobody_listens(host, port) ? lost + 1 : 0)
      ::poll(nullptr, 0, kWatch);
    if (navvi_config::ending()) return;  // as a master does that roslaunch has ended
    navvi_config::end();
    if (navvi_config::is_roslaunch(::getppid())) ::kill(::getppid(), SIGINT);
  }).detach();
}

void SessionParts::note() {
  for (const auto& [node, reason] : kParts) addresses_[node] = address_of(node);
}

std::string SessionParts::crashed() const {
  if (launcher_has_ended(kThreads)) return "launcher_lost";
  // The master ends with its launcher, and may be through with it first.
  if (nobody_listens(ros::master::getHost(), ros::master::getPort()))
    return launcher_has_ended(kBusy) ? "launcher_lost" : "master_lost";
  for (const auto& [node, reason] : kParts) {
    const std::string address = address_of(node);
    if (address.empty()) continue;
    const auto noted = addresses_.find(node);
    if (noted != addresses_.end() && !noted->second.empty() && noted->second != address)
      return "name_taken";
    std::string host;
    std::uint32_t port = 0;
    if (ros::network::splitURI(address, host, port) && nobody_listens(host, port)) return reason;
  }
  return {};
}

}  // namespace navvi_study::node
