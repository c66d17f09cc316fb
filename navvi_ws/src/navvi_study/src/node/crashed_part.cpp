#include "node/crashed_part.hpp"

#include <netdb.h>
#include <poll.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <navvi_config/launcher.hpp>

namespace navvi_study::node {
namespace {

constexpr int kPatience = 300;              // ms
constexpr int kThreads = 10, kThread = 10;  // looks, and ms between two of them

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

bool crashed(const char* node) {
  XmlRpc::XmlRpcValue request, response, address;
  request[0] = ros::this_node::getName();
  request[1] = node;
  std::string host;
  std::uint32_t port = 0;
  return ros::master::execute("lookupNode", request, response, address, false) &&
         ros::network::splitURI(address, host, port) && nobody_listens(host, port);
}

}  // namespace

std::string crashed_part() {
  // The signal may come when the first of roslaunch's threads has ended, and the last has not yet.
  for (int i = 0; i < kThreads; ++i) {
    if (navvi_config::parent_has_ended()) return "launcher_lost";
    ::poll(nullptr, 0, kThread);
  }
  if (nobody_listens(ros::master::getHost(), ros::master::getPort())) return "master_lost";
  if (crashed("/sim_node")) return "simulator_lost";
  if (crashed("/perception_node")) return "perception_lost";
  if (crashed("/relay_node")) return "relay_lost";
  return {};
}

}  // namespace navvi_study::node
