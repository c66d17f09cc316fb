#pragma once

#include <ros/ros.h>

#include <QKeyEvent>
#include <QTimer>
#include <QWidget>
#include <memory>

#include "plugin/window_keys.hpp"

namespace navvi_rviz::plugin {

/// Keys that are typed into RViz's window drive and ask as those of feedback_node's own window do,
/// where that listens to them: published as a stick, while no button or list has the focus. An
/// empty message says that the window has lost them. How fast RViz draws does not matter.
class Keys : public QObject {
 public:
  /// \param child  of the window that is meant; outlives this
  explicit Keys(const QWidget& child);

  bool eventFilter(QObject* target, QEvent* event) override;

 private:
  void watch();
  /// Whether nobody else is to have it.
  bool take(const QKeyEvent& event);

  const QWidget& child_;
  ros::NodeHandle node_;
  ros::Publisher keys_;
  QTimer timer_;
  bool heard_ = false;  ///< somebody listens
  /// The last key that was let go. X lets a key that is held go and presses it at the same
  /// millisecond, again and again. QKeyEvent::isAutoRepeat() is not to be trusted: it says no where
  /// Qt did not read both at once, and yes for a press after a release in another window.
  struct {
    int key = 0;
    unsigned long stamp = 0;  ///< ms
  } up_;
  std::unique_ptr<WindowKeys> window_keys_;  ///< the last: its thread publishes
};

}  // namespace navvi_rviz::plugin
