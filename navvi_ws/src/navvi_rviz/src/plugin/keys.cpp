#include "plugin/keys.hpp"

#include <sensor_msgs/Joy.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <algorithm>
#include <array>

namespace navvi_rviz::plugin {
namespace {

constexpr int kLeast = 3;  // messages that hold a press, so that no tick of feedback_node misses it
constexpr int kPeriod = 20;    // ms
constexpr float kSlow = 0.4F;  // of the stick, with Shift
constexpr int kNone = 0;       // no key

/// In the places of a pad's buttons, as feedback_node's own window has them.
constexpr std::array<int, 15> kButtons = {Qt::Key_Space,
                                          Qt::Key_G,
                                          Qt::Key_A,
                                          Qt::Key_W,
                                          Qt::Key_Escape,
                                          Qt::Key_H,
                                          Qt::Key_Return,
                                          kNone,
                                          kNone,
                                          kNone,
                                          Qt::Key_T,
                                          Qt::Key_PageUp,
                                          Qt::Key_PageDown,
                                          Qt::Key_Backspace,
                                          kNone};

bool ours(const QKeyEvent& event) {
  const int key = event.key();
  if ((event.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) != 0) return false;
  return key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_Left || key == Qt::Key_Right ||
         key == Qt::Key_Shift || std::find(kButtons.begin(), kButtons.end(), key) != kButtons.end();
}

/// What has keys of its own.
bool takes_keys(const QWidget* widget) {
  return qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QComboBox*>(widget) ||
         qobject_cast<const QAbstractItemView*>(widget) ||
         qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QLineEdit*>(widget);
}

}  // namespace

Keys::Keys(const QWidget& child)
    : child_(child), keys_(node_.advertise<sensor_msgs::Joy>("navvi/keys", 1)) {
  connect(&timer_, &QTimer::timeout, this, [this] { publish(); });
  timer_.start(kPeriod);
  QApplication::instance()->installEventFilter(this);
}

bool Keys::drive() const {
  return keys_.getNumSubscribers() > 0 && QApplication::activeWindow() == child_.window() &&
         !QApplication::activePopupWidget() && !takes_keys(QApplication::focusWidget());
}

void Keys::publish() {
  const bool driving = drive();
  if (!driving) down_.clear();
  const auto down = [&](int key) { return down_.count(key) > 0; };
  sensor_msgs::Joy msg;
  msg.header.stamp = ros::Time::now();
  if (driving) {
    const float full = down(Qt::Key_Shift) ? kSlow : 1.0F;
    const auto axis = [&](int plus, int minus) {
      return full *
             static_cast<float>(static_cast<int>(down(plus)) - static_cast<int>(down(minus)));
    };
    msg.axes = {axis(Qt::Key_Left, Qt::Key_Right), axis(Qt::Key_Up, Qt::Key_Down)};
    for (const int key : kButtons) msg.buttons.push_back(down(key) ? 1 : 0);
  }
  if (driving || driving_) keys_.publish(msg);
  for (auto key = down_.begin(); key != down_.end();) {
    const bool over = ++key->second.sent >= kLeast && key->second.released;
    key = over ? down_.erase(key) : std::next(key);
  }
  driving_ = driving;
}

bool Keys::eventFilter(QObject* target, QEvent* event) {
  if (event->type() == QEvent::WindowDeactivate && target == child_.window()) down_.clear();
  const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease ||
                   event->type() == QEvent::ShortcutOverride;
  if (key && take(*static_cast<QKeyEvent*>(event))) {
    event->accept();
    return true;
  }
  return QObject::eventFilter(target, event);
}

bool Keys::take(const QKeyEvent& event) {
  const int key = event.key();
  const bool repeated = key == up_.key && event.timestamp() == up_.stamp;
  if (event.type() == QEvent::KeyRelease) {
    const auto held = down_.find(key);  // not there if it was pressed elsewhere
    up_ = {key, event.timestamp(), held != down_.end()};
    if (up_.held) held->second.released = true;
  }
  if (!drive() || !ours(event))  // who cannot let go soon asks once
    return event.type() == QEvent::ShortcutOverride && repeated &&
           !takes_keys(QApplication::focusWidget());
  if (event.type() == QEvent::KeyPress && (!repeated || up_.held)) down_[key] = {};
  return true;
}

}  // namespace navvi_rviz::plugin
