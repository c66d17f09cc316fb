#include "plugin/keys.hpp"

#include <sensor_msgs/Joy.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <algorithm>
#include <array>

namespace navvi_rviz::plugin {
namespace {

constexpr int kPeriod = 50;  // ms

/// As WindowKeys reads them.
constexpr std::array kOurs = {
    Qt::Key_Up, Qt::Key_Down,   Qt::Key_Left,     Qt::Key_Right,     Qt::Key_Shift, Qt::Key_Space,
    Qt::Key_G,  Qt::Key_A,      Qt::Key_W,        Qt::Key_F8,        Qt::Key_H,     Qt::Key_Return,
    Qt::Key_T,  Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Backspace, Qt::Key_Escape};

bool ours(const QKeyEvent& event) {
  return (event.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0 &&
         std::find(kOurs.begin(), kOurs.end(), event.key()) != kOurs.end();
}

/// What has keys of its own.
bool takes_keys(const QWidget* widget) {
  return qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QComboBox*>(widget) ||
         qobject_cast<const QAbstractItemView*>(widget) ||
         qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QLineEdit*>(widget);
}

/// Nothing in the window has keys of its own.
bool free_keys() {
  return !QApplication::activePopupWidget() && !takes_keys(QApplication::focusWidget());
}

void publish(const ros::Publisher& keys, const Typed* typed) {
  if (keys.getNumSubscribers() == 0) return;
  sensor_msgs::Joy msg;
  msg.header.stamp = ros::Time::now();
  if (typed != nullptr) {
    msg.axes.assign(typed->axes.begin(), typed->axes.end());
    msg.buttons.assign(typed->buttons.begin(), typed->buttons.end());
  }
  keys.publish(msg);
}

}  // namespace

Keys::Keys(const QWidget& child)
    : child_(child),
      keys_(node_.advertise<sensor_msgs::Joy>("navvi/keys", 100)),
      window_keys_(std::make_unique<WindowKeys>(
          [keys = keys_](const Typed* typed) { publish(keys, typed); })) {
  connect(&timer_, &QTimer::timeout, this, [this] { watch(); });
  timer_.start(kPeriod);
  connect(qApp, &QApplication::focusChanged, this, [this] { watch(); });
  QApplication::instance()->installEventFilter(this);
}

void Keys::watch() {
  QWidget* const window = child_.window();
  window_keys_->watch(window->isVisible() ? window->winId() : 0, free_keys());
  const bool heard = keys_.getNumSubscribers() > 0;
  // The small window of the keys goes; this one takes its place.
  if (heard && !heard_) window->activateWindow();
  heard_ = heard;
}

bool Keys::eventFilter(QObject* target, QEvent* event) {
  const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease ||
                   event->type() == QEvent::ShortcutOverride;
  if (key && take(*static_cast<QKeyEvent*>(event))) {
    event->accept();
    return true;
  }
  return QObject::eventFilter(target, event);
}

bool Keys::take(const QKeyEvent& event) {
  const bool repeated = event.key() == up_.key && event.timestamp() == up_.stamp;
  if (event.type() == QEvent::KeyRelease) up_ = {event.key(), event.timestamp()};
  const bool drives = keys_.getNumSubscribers() > 0 &&
                      QApplication::activeWindow() == child_.window() && free_keys();
  if (drives && ours(event)) return true;
  // Who cannot let go soon asks once.
  return event.type() == QEvent::ShortcutOverride && repeated &&
         !takes_keys(QApplication::focusWidget());
}

}  // namespace navvi_rviz::plugin
