#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <thread>

namespace navvi_rviz::plugin {

/// The keys that drive and ask, as a pad has them.
struct Typed {
  std::array<float, 2> axes = {};     ///< [-1, 1]: left positive, forward positive
  std::array<bool, 16> buttons = {};  ///< laid out like a gamepad's, and escape after them
};

/// Reads the keys that are typed into a window, by a connection to the X server and a thread of its
/// own: a picture that takes seconds delays none and loses none. A key that is down when the window
/// gets the focus counts only once it was released.
class WindowKeys {
 public:
  /// \param tell  called in the thread at each change and each 20 ms; nullptr: the window has no
  /// focus, or its keys are somebody else's
  explicit WindowKeys(std::function<void(const Typed*)> tell);
  ~WindowKeys();

  /// \param window  X's number of it; 0: none yet \param ours  false while something in it, such as
  /// a list, has keys of its own
  void watch(unsigned long window, bool ours) {
    window_ = window;
    ours_ = ours;
  }

 private:
  class Reader;
  void run(Reader& reader);

  std::function<void(const Typed*)> tell_;
  std::atomic<unsigned long> window_{0};
  std::atomic<bool> ours_{false};
  std::atomic<bool> quit_{false};
  std::unique_ptr<Reader> reader_;
  std::thread thread_;
};

}  // namespace navvi_rviz::plugin
