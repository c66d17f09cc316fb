#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sys/stat.h>

#include <new>
#include <optional>
#include <string>

#include "navvi_config/launcher.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_config {

/// All parameters under `node`'s namespace, as YAML; an empty map if there are none.
[[nodiscard]] YAML::Node parameters(const ros::NodeHandle& node);

/// Reads `Config` from the parameters under `node`, usually the private NodeHandle("~").
/// \throws ConfigError as read() does
template <typename Config>
[[nodiscard]] Config load(const ros::NodeHandle& node) {
  Config config;
  read(config, parameters(node), "the parameters of " + node.getNamespace(), Removed::ignored);
  return config;
}

/// Lets this process open as many files at once as a node may need, of which each link to another
/// node is one. \throws ConfigError if the system does not allow that: a node that runs out of them
/// hangs without a word
void allow_files();

/// To 4 GB: roscpp makes an array as long as a message says before it looks for its content, and
/// then drops a message for which there is no memory.
void limit_memory();

/// Asks the system to run this program before others, so that a busy machine delays neither motors
/// nor words. Call it before the program has threads; they inherit it. The kernel grants it to
/// root, or by a limit (/etc/security/limits.d: "@audio - nice -10").
/// \param niceness  [-20, -1], of which -20 goes first
void ask_for_priority(int niceness);

/// ros::init, but Ctrl-C, SIGTERM, SIGHUP, SIGQUIT and a request by XML-RPC end spin(), where
/// roscpp would close the topics before the last messages, and lose a signal that comes while it
/// starts.
void init(int& argc, char** argv, const std::string& name);
/// \return whether there is a master: roscpp waits for it where no signal ends the wait
[[nodiscard]] bool await_master();
void end();  ///< ends both waits
[[nodiscard]] bool ending();
void spin();  ///< handles callbacks until then
/// Lets the messages that were published leave.
void flush();

/// Waits, 0.5 s at most, for those who wait for this topic already, such as the record for the first
/// words of a node that is started anew: what is published before a link is up, nobody gets.
void await_readers(const ros::Publisher& topic);

/// Ends this node once a master or a person asks for it by XML-RPC. Where the reason is a second
/// node of its name, that is logged as a fatal error, and name_is_taken() from then on.
void end_on_request();
[[nodiscard]] bool name_is_taken();
/// Whether it was asked to end, or its name taken: the session goes on without it.
[[nodiscard]] bool ends_alone();

/// Logs what a new start would meet again, ends the roslaunch of this node, and returns code 2.
[[nodiscard]] int reject(const std::string& error);

struct NoParameters {
  void describe(Visitor& /*visit*/) {}
};

/// The rest of a node's main() after init(): runs `body` with the parameters, and ends with the
/// roslaunch that started it. An exception is logged as a fatal error. What the node writes is its
/// owner's alone.
/// \param body  takes a Config, returns the exit code
/// \return the exit code: 2 if a parameter is rejected, 3 after any other exception or where
/// another node has taken the name
template <typename Config, typename Body>
[[nodiscard]] int run_node(const Body& body) {
  end_with_launcher();
  ::umask(S_IRWXG | S_IRWXO);
  // Without one, roscpp shuts down before an error is logged.
  std::optional<ros::NodeHandle> alive;
  try {
    allow_files();
    limit_memory();
    if (!await_master()) return 0;
    alive.emplace();
    end_on_request();
    const int code = body(load<Config>(ros::NodeHandle("~")));
    return name_is_taken() ? 3 : code;
  } catch (const ConfigError& error) {
    return reject(error.what());
  } catch (const std::bad_alloc&) {
    ROS_FATAL("There is not enough memory for what came; this node ends.");
    return 3;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 3;
  }
}

}  // namespace navvi_config
