#include "plugin/panel.hpp"

#include <navvi_msgs/TrialRequest.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <std_msgs/String.h>

#include <QAccessible>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QMainWindow>
#include <QMenuBar>
#include <QScreen>
#include <QShortcut>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include "plugin/chosen.hpp"
#include "plugin/paint.hpp"
#include "plugin/views.hpp"

namespace navvi_rviz::plugin {
namespace {

constexpr int kRefresh = 100;  // ms
constexpr int kPadding = 4;    // px, around words

QString number(double value, int decimals, const char* unit) {
  return QString::number(value, 'f', decimals) + " " + QString::fromUtf8(unit);
}

/// A screen reader says what changed by itself.
void set_words(QLabel* label, const QString& words, QAccessible::Event event) {
  // Docks do not ask how high wrapped words are; two lines always, or the picture changes its size.
  if (label->wordWrap())
    label->setMinimumHeight(std::max(2 * label->fontMetrics().lineSpacing() + 2 * kPadding,
                                     label->heightForWidth(label->width())));
  if (label->text() == words) return;
  label->setText(words);
  QAccessibleEvent said(label, event);
  QAccessible::updateAccessibility(&said);
}

}  // namespace

Panel::Panel()
    : rows_{new QHBoxLayout, new QHBoxLayout, new QHBoxLayout,
            new QHBoxLayout, new QHBoxLayout, new QHBoxLayout},
      labels_{add_label(rows_.words, "state", 1),      add_label(rows_.words, "instruction", 1),
              add_label(rows_.numbers, "distance", 1), add_label(rows_.numbers, "speed", 1),
              add_label(rows_.numbers, "time", 0),     add_label(rows_.offer, "menu", 1)},
      pages_(new QStackedWidget) {
  setAttribute(Qt::WA_StyledBackground);
  labels_.menu->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* rows = new QVBoxLayout(this);
  rows->addLayout(rows_.words);
  rows->addLayout(rows_.numbers);
  rows->addWidget(pages_);
  for (const auto& [upper, lower] :
       {std::pair{rows_.questions, rows_.view}, {rows_.offer, rows_.menu}}) {
    auto* page = new QWidget;
    auto* both = new QVBoxLayout(page);
    both->setContentsMargins(0, 0, 0, 0);
    both->addLayout(upper);
    both->addLayout(lower);
    pages_->addWidget(page);
  }
}

QLabel* Panel::add_label(QHBoxLayout* row, const char* name, int stretch) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setAccessibleDescription(name);
  label->setFocusPolicy(Qt::TabFocus);
  label->setWordWrap(row == rows_.words);
  row->addWidget(label, stretch);
  return label;
}

QPushButton* Panel::add_button(QHBoxLayout* row, const Named& named,
                               const std::function<void()>& action, QWidget* scope) {
  auto* button = new QPushButton;
  button->setFocusPolicy(Qt::TabFocus);  // a click must not take the focus from the keys that drive
  connect(button, &QPushButton::clicked, this, action);
  auto* shortcut = new QShortcut(named.key, scope);
  shortcut->setContext(Qt::ApplicationShortcut);
  connect(shortcut, &QShortcut::activated, this, action);
  row->addWidget(button, static_cast<int>(named.words.size()));
  named_.push_back(named);
  named_.back().button = button;
  return button;
}

/// Buttons name the keys as the voice does to who drives by keys.
void Panel::name_all() {
  const status::Words& words = reader_->words();
  const auto of = [&](const std::string& key) { return QString::fromStdString(words.of(key)); };
  for (const Named& named : named_) {
    const bool spoken = reader_->keyboard() && !named.spoken.empty();
    const QString key = spoken ? of("lessons/" + named.spoken) : named.key.toString();
    const QString name = of("picture/" + named.words);
    if (const QString text = name + " (" + key + ")"; named.button->text() != text) {
      named.button->setText(text);
      named.button->setAccessibleName(name);
      named.button->setAccessibleDescription(of("picture/key") + " " + key);
    }
  }
  const QString vision = of("picture/vision");
  if (vision_->text() == "&" + vision) return;
  vision_->setText("&" + vision);
  visions_->setAccessibleName(vision);
  visions_->setAccessibleDescription(vision);
  for (int i = 0; i < visions_->count(); ++i)
    visions_->setItemText(i,
                          of("picture/vision_" + visions_->itemData(i).toString().toStdString()));
}

void Panel::onInitialize() {
  reader_ = std::make_unique<Reader>();
  questions_ = node_.advertise<std_msgs::String>("navvi/ask", 10);
  requests_ = node_.advertise<navvi_msgs::TrialRequest>("navvi/trial_request", 10);
  add_questions();
  add_views();
  add_menu();
  name_all();
  Chosen::shared().on_change([this] { style(); });
  style();
  connect(&timer_, &QTimer::timeout, this, [this] { refresh(); });
  timer_.start(kRefresh);
  QTimer::singleShot(0, this, [this] { fill_screen(); });
}

void Panel::add_questions() {
  using Request = navvi_msgs::TrialRequest;
  const auto add = [&](const Named& named, const std::function<void()>& action) {
    add_button(rows_.questions, named, action, this);
  };
  add({nullptr, "begin", Qt::Key_F5, "key_6"}, [this] { request(Request::BEGIN); });
  add({nullptr, "end", Qt::Key_F8, ""}, [this] { ask("end"); });
  add({nullptr, "repeat", Qt::Key_R, "key_0"}, [this] { ask("repeat"); });
  add({nullptr, "goal", Qt::Key_G, ""}, [this] { ask("goal"); });
  add({nullptr, "around", Qt::Key_A, ""}, [this] { ask("around"); });
}

void Panel::add_menu() {
  QWidget* const page = pages_->widget(1);
  const auto add = [&](const char* words, const QKeySequence& key, const char* spoken,
                       const char* question) {
    return add_button(
        rows_.menu, {nullptr, words, key, spoken}, [this, question] { ask(question); }, page);
  };
  down_ = add("down", Qt::Key_PageDown, "key_12", "next");
  add("up", Qt::Key_PageUp, "key_11", "previous");
  add("choose", Qt::Key_Return, "key_14", "choose");
  add("back", Qt::Key_Backspace, "key_13", "back");
  auto* leave = new QShortcut(Qt::Key_Escape, page);
  leave->setContext(Qt::ApplicationShortcut);
  connect(leave, &QShortcut::activated, this, [this] { ask("leave"); });
}

void Panel::add_views() {
  const std::pair<const char*, const char*> views[] = {
      {"chase", "Chase"}, {"top", "Top"}, {"forward", "Forward"}};
  for (int i = 0; i < 3; ++i)
    add_button(
        rows_.view, {nullptr, views[i].first, QKeySequence(Qt::Key_1 + i), ""},
        [this, view = views[i].second] { choose_view(*vis_manager_, view); }, this);
  add_button(
      rows_.view, {nullptr, "rviz", Qt::Key_F2, ""}, [this] { show_chrome(!chrome_); }, this);
  settings_ = add_button(
      rows_.view, {nullptr, "settings", Qt::Key_F3, ""}, [this] { ask("settings"); }, this);

  visions_ = new QComboBox;
  visions_->setFocusPolicy(Qt::TabFocus);
  for (const std::string& name : look::vision_names())
    visions_->addItem(QString::fromStdString(name), QString::fromStdString(name));
  visions_->setCurrentIndex(visions_->findData(QString::fromStdString(Chosen::shared().name())));
  connect(visions_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this](int chosen) {
    Chosen::shared().choose(visions_->itemData(chosen).toString().toStdString());
  });
  vision_ = new QLabel;
  vision_->setBuddy(visions_);
  vision_->setObjectName("vision");
  rows_.view->addWidget(vision_);
  rows_.view->addWidget(visions_);
}

void Panel::ask(const std::string& question) {
  std_msgs::String msg;
  msg.data = question;
  questions_.publish(msg);
}

void Panel::request(std::uint8_t what) {
  navvi_msgs::TrialRequest msg;
  msg.header.stamp = ros::Time::now();
  msg.request = what;
  requests_.publish(msg);
}

void Panel::fill_screen() {
  auto* main = qobject_cast<QMainWindow*>(window());
  auto* dock = qobject_cast<QDockWidget*>(parentWidget());
  if (!main || !dock) return;
  dock->setTitleBarWidget(new QWidget(dock));
  main->addDockWidget(Qt::BottomDockWidgetArea, dock);
  dock->show();
  show_chrome(false);
  main->setGeometry(main->screen()->availableGeometry());
  main->showMaximized();
  main->installEventFilter(this);
  vis_manager_->getRenderPanel()->setFocus();
}

bool Panel::eventFilter(QObject* target, QEvent* event) {
  const bool closes = target == window() && event->type() == QEvent::Close;
  if (!closes || !ros::ok() || !reader_->trial_runs())
    return rviz::Panel::eventFilter(target, event);
  ask("end");
  event->ignore();
  return true;
}

void Panel::show_chrome(bool visible) {
  chrome_ = visible;
  auto* main = qobject_cast<QMainWindow*>(window());
  if (!main) return;
  main->menuBar()->setVisible(visible);
  main->statusBar()->setVisible(visible);
  for (QToolBar* bar : main->findChildren<QToolBar*>()) bar->setVisible(visible);
  for (QDockWidget* dock : main->findChildren<QDockWidget*>())
    if (dock != parentWidget()) dock->setVisible(visible);
  if (auto* frame = dynamic_cast<rviz::VisualizationFrame*>(main))
    frame->setHideButtonVisibility(visible);
}

void Panel::style() {
  const look::Vision& vision = Chosen::shared().vision();
  const QString text = color(vision.text).name(), plate = color(vision.plate).name();
  // As large for the eye on any screen, but for small ones: there the words would not fit.
  const double zoom = std::clamp(screen()->size().height() / 1080.0, 0.7, 2.0);
  const double height = zoom * vision.text_height;
  setStyleSheet(
      QString("QWidget { background: %2; color: %1; font: bold %3px 'DejaVu Sans'; }"
              "QLabel { padding: %5px; }"
              "QPushButton, QComboBox, QLabel#vision, QLabel#menu { font-size: %4px; }"
              "QPushButton, QComboBox { border: 2px solid %1; padding: 4px; }"
              "QPushButton:pressed { background: %1; color: %2; }"
              "QLabel:focus, QPushButton:focus, QComboBox:focus { border: 5px double %1; }"
              "QLabel[alarm=\"true\"] { background: %1; color: %2; }")
          .arg(text, plate)
          .arg(font_size(height))
          .arg(font_size(std::max(26.0 * zoom, 0.55 * height)))
          .arg(kPadding));
}

void Panel::show_menu(const QString& words) {
  set_words(labels_.menu, words, QAccessible::Alert);
  QWidget* const page = pages_->widget(words.isEmpty() ? 0 : 1);
  QWidget* const last = pages_->currentWidget();
  if (page == last) return;
  const bool focus = last->isAncestorOf(QApplication::focusWidget());
  pages_->setCurrentWidget(page);
  if (focus) (words.isEmpty() ? settings_ : down_)->setFocus();
}

void Panel::refresh() {
  const status::Shown shown = reader_->shown();
  const status::Words& words = reader_->words();
  name_all();
  show_menu(QString::fromStdString(shown.menu));
  const bool alarm = shown.tone == status::Shown::Tone::alarm && !shown.banner.empty();
  if (labels_.state->property("alarm").toBool() != alarm) {
    labels_.state->setProperty("alarm", alarm);
    style();
  }
  const std::string calm = words.of(shown.sound ? "picture/drive" : "picture/drive_no_sound");
  set_words(labels_.state, QString::fromStdString(shown.banner.empty() ? calm : shown.banner),
            QAccessible::Alert);
  set_words(labels_.instruction, QString::fromStdString(shown.instruction),
            QAccessible::NameChanged);
  const std::string to_go = words.of("picture/to_go");
  set_words(labels_.distance, shown.distance ? number(*shown.distance, 0, to_go.c_str()) : "",
            QAccessible::NameChanged);
  set_words(labels_.speed, number(shown.speed, 1, "m/s"), QAccessible::NameChanged);
  const int seconds = static_cast<int>(shown.clock.value_or(0.0));
  set_words(labels_.clock,
            QString("%1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QLatin1Char('0')),
            QAccessible::NameChanged);
}

}  // namespace navvi_rviz::plugin
