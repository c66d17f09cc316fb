#pragma once

#include <ros/ros.h>

#include <QKeyEvent>
#include <QTimer>
#include <QWidget>
#include <map>

namespace navvi_rviz::plugin {

/// Keys that are typed into RViz's window drive and ask as those of feedback_node's own window do,
/// where that listens to them: published as a stick, while no button or list has the focus. An
/// empty message says that the window has lost them.
class Keys : public QObject {
 public:
  /// \param child  of the window that is meant; outlives this
  explicit Keys(const QWidget& child);

  bool eventFilter(QObject* target, QEvent* event) override;

 private:
  /// Whether the keys are ours now.
  [[nodiscard]] bool drive() const;
  /// Whether nobody else is to have it.
  bool take(const QKeyEvent& event);
  void publish();

  const QWidget& child_;
  ros::NodeHandle node_;
  ros::Publisher keys_;
  QTimer timer_;
  /// A short press may begin and end while a picture is drawn.
  struct Press {
    int sent = 0;  ///< messages
    bool released = false;
  };
  std::map<int, Press> down_;  ///< by Qt::Key
  /// The last key that was let go. X lets a key that is held go and presses it at the same
  /// millisecond, again and again. QKeyEvent::isAutoRepeat() is not to be trusted: it says no where
  /// Qt did not read both at once, and yes for a press after a release in another window.
  struct {
    int key = 0;
    unsigned long stamp = 0;  ///< ms
    bool held = false;        ///< and drove until then
  } up_;
  bool driving_ = false;
};

}  // namespace navvi_rviz::plugin
