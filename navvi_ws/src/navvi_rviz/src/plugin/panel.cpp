#include "plugin/panel.hpp"

#include <navvi_msgs/TrialRequest.h>
#include <rviz/display.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <std_msgs/String.h>

#include <QAccessible>
#include <QApplication>
#include <QDockWidget>
#include <QMenuBar>
#include <QScreen>
#include <QShortcut>
#include <QStatusBar>
#include <QStyle>
#include <QToolBar>
#include <QVBoxLayout>

#include "plugin/chosen.hpp"
#include "plugin/paint.hpp"

namespace navvi_rviz::plugin {
namespace {

constexpr int kRefresh = 100;        // ms
constexpr int kSpace = 4;            // px, between the parts
constexpr double kShare = 0.4;       // of the window, at most: the rest is the picture's
constexpr double kLetters = 26.0;    // px, of capital letters on a screen of 1080 rows
constexpr double kLeast = 12.0;      // px, of them, however small the window

QString number(double value, int decimals, const char* unit) {
  return QString::number(value, 'f', decimals) + " " + QString::fromUtf8(unit);
}

/// Of the robot's camera.
bool shows_picture(const QDockWidget& dock) {
  return dock.findChild<rviz::RenderPanel*>() != nullptr;
}

/// A screen reader says what changed by itself.
void set_words(QLabel* label, const QString& words, QAccessible::Event event) {
  if (label->text() == words) return;
  label->setText(words);
  QAccessibleEvent said(label, event);
  QAccessible::updateAccessibility(&said);
}

}  // namespace

Panel::Panel()
    : rows_{new QHBoxLayout, new FlowLayout, new FlowLayout},
      labels_{add_label(rows_.numbers, "state", 4),    new WordsLabel(2),
              add_label(rows_.numbers, "distance", 3), add_label(rows_.numbers, "speed", 2),
              add_label(rows_.numbers, "time", 1),     new WordsLabel(1)},
      pages_(new QStackedWidget) {
  setAttribute(Qt::WA_StyledBackground);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  for (QLayout* layout :
       std::initializer_list<QLayout*>{rows, rows_.numbers, rows_.buttons, rows_.menu})
    layout->setSpacing(kSpace);
  name(labels_.instruction, "instruction");
  name(labels_.menu, "menu");
  pages_->addWidget(labels_.instruction);
  auto* page = new QWidget;
  auto* offer = new QVBoxLayout(page);
  offer->setContentsMargins(0, 0, 0, 0);
  offer->setSpacing(0);
  offer->addWidget(labels_.menu);
  offer->addLayout(rows_.menu);
  pages_->addWidget(page);
  rows->addWidget(pages_);
  rows->addLayout(rows_.numbers);
  rows->addLayout(rows_.buttons);
}

void Panel::name(QLabel* label, const char* name) {
  label->setObjectName(name);
  label->setAccessibleDescription(name);
  label->setFocusPolicy(Qt::TabFocus);
}

QLabel* Panel::add_label(QHBoxLayout* row, const char* name, int stretch) {
  auto* label = new WordsLabel(1);
  Panel::name(label, name);
  row->addWidget(label, stretch);
  return label;
}

QPushButton* Panel::add_button(QLayout* row, const Named& named,
                               const std::function<void()>& action, QWidget* scope) {
  auto* button = new QPushButton;
  button->setFocusPolicy(Qt::TabFocus);  // a click must not take the focus from the keys that drive
  connect(button, &QPushButton::clicked, this, action);
  auto* shortcut = new QShortcut(named.key, scope);
  shortcut->setContext(Qt::ApplicationShortcut);
  connect(shortcut, &QShortcut::activated, this, action);
  row->addWidget(button);
  named_.push_back(named);
  named_.back().button = button;
  return button;
}

/// Buttons name the keys as the voice does to who drives by keys.
void Panel::name_all() {
  const status::Words& words = reader_->status().words();
  const auto of = [&](const std::string& key) { return QString::fromStdString(words.of(key)); };
  for (const Named& named : named_) {
    const bool spoken = !named.spoken.empty() && (named.same || reader_->status().keyboard());
    const QString key = spoken ? of("lessons/" + named.spoken) : named.key.toString();
    const QString name = of("picture/" + named.words);
    // The largest letters leave no room for keys.
    const bool plain = Chosen::shared().vision().text_height > kLetters;
    if (const QString text = plain ? name : name + " (" + key + ")"; named.button->text() != text) {
      named.button->setText(text);
      named.button->setAccessibleName(name);
      named.button->setAccessibleDescription(of("picture/key") + " " + key);
      fitted_ = {};
    }
  }
  const QString vision = of("picture/vision");
  if (vision_->text() == "&" + vision) return;
  fitted_ = {};
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
  Chosen::shared().on_change([this] { fit(); });
  fit();
  connect(&timer_, &QTimer::timeout, this, [this] { refresh(); });
  timer_.start(kRefresh);
  QTimer::singleShot(0, this, [this] { fill_screen(); });
}

void Panel::add_questions() {
  using Request = navvi_msgs::TrialRequest;
  const auto add = [&](const Named& named, const std::function<void()>& action) {
    add_button(rows_.buttons, named, action, this);
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
        rows_.menu, {nullptr, words, key, spoken, true}, [this, question] { ask(question); }, page);
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
        rows_.buttons, {nullptr, views[i].first, QKeySequence(Qt::Key_1 + i), ""},
        [this, view = views[i].second] { choose_view(*vis_manager_, view); }, this);
  add_button(
      rows_.buttons, {nullptr, "rviz", Qt::Key_F2, ""}, [this] { show_chrome(!chrome_); }, this);
  settings_ = add_button(
      rows_.buttons, {nullptr, "settings", Qt::Key_F3, ""}, [this] { ask("settings"); }, this);

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
  auto* both = new QWidget;
  auto* side_by_side = new QHBoxLayout(both);
  side_by_side->setContentsMargins(0, 0, 0, 0);
  side_by_side->addWidget(vision_);
  side_by_side->addWidget(visions_, 1);
  rows_.buttons->addWidget(both);
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
  show_camera(*main);
  show_chrome(false);
  main->setGeometry(main->screen()->availableGeometry());
  main->showMaximized();
  main->installEventFilter(this);
  vis_manager_->getRenderPanel()->setFocus();
}

void Panel::show_camera(QMainWindow& main) {
  if (!ros::param::param<bool>("~camera", false)) return;
  rviz::Display* camera = vis_manager_->createDisplay("rviz/Camera", "Camera of the robot", false);
  camera->subProp("Image Topic")->setValue("/navvi/camera/image");
  camera->subProp("Image Rendering")->setValue("background");
  camera->setEnabled(true);
  for (QDockWidget* dock : main.findChildren<QDockWidget*>()) {
    if (!shows_picture(*dock)) continue;
    main.addDockWidget(Qt::RightDockWidgetArea, dock);
    dock->setTitleBarWidget(new QWidget(dock));
    dock->show();
    main.resizeDocks({dock}, {main.screen()->size().width() / 2}, Qt::Horizontal);
  }
}

bool Panel::eventFilter(QObject* target, QEvent* event) {
  const bool closes = target == window() && event->type() == QEvent::Close;
  // In a replay nobody hears the question.
  if (!closes || !ros::ok() || !reader_->status().trial_runs() || !questions_.getNumSubscribers())
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
    if (dock != parentWidget() && !shows_picture(*dock)) dock->setVisible(visible);
  if (auto* frame = dynamic_cast<rviz::VisualizationFrame*>(main))
    frame->setHideButtonVisibility(visible);
}

/// Letters are as large for the eye on any screen, but smaller where the panel would take more of
/// the window than its share: first those of the buttons.
void Panel::fit() {
  const int wide = width() - 2 * kSpace;
  const double zoom = std::clamp(screen()->size().height() / 1080.0, 0.7, 2.0);
  double large = zoom * Chosen::shared().vision().text_height, rest = large;
  int said = 0, height = 0;  // px
  for (style(large, rest); rest > kLeast; style(large, rest)) {
    said = std::max(labels_.instruction->sizeHint().height(),
                    labels_.menu->sizeHint().height() + rows_.menu->heightForWidth(wide));
    height = said + labels_.state->sizeHint().height() + rows_.buttons->heightForWidth(wide) +
             4 * kSpace;
    if (height <= kShare * window()->height()) break;
    if (rest <= zoom * kLetters) large *= 0.97;
    rest = std::min(0.97 * rest, large);
  }
  pages_->setFixedHeight(said);
  setFixedHeight(height);
  fitted_ = window()->size();
}

void Panel::style(double said, double rest) {
  const look::Vision& vision = Chosen::shared().vision();
  const QString text = color(vision.text).name(), plate = color(vision.plate).name();
  setStyleSheet(
      QString("QWidget { background: %2; color: %1; font: bold %4px 'DejaVu Sans'; }"
              "QLabel#instruction { font-size: %3px; }"
              "QPushButton, QComboBox { border: 2px solid %1; padding: 4px; }"
              "QPushButton:pressed { background: %1; color: %2; }"
              "QLabel:focus, QPushButton:focus, QComboBox:focus { border: 5px double %1; }"
              "QLabel[alarm=\"true\"] { background: %1; color: %2; }")
          .arg(text, plate)
          .arg(font_size(said))
          .arg(font_size(rest)));
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
  const status::Words& words = reader_->status().words();
  preview_.update(reader_->goal_ahead());
  name_all();
  if (fitted_ != window()->size()) fit();
  show_menu(QString::fromStdString(shown.menu));
  const bool alarm = shown.tone == status::Shown::Tone::alarm && !shown.banner.empty();
  if (labels_.state->property("alarm").toBool() != alarm) {
    labels_.state->setProperty("alarm", alarm);
    labels_.state->style()->unpolish(labels_.state);
    labels_.state->style()->polish(labels_.state);
  }
  const std::string calm = words.of(shown.sound ? "picture/drive" : "picture/drive_no_sound");
  set_words(labels_.state, QString::fromStdString(shown.banner.empty() ? calm : shown.banner),
            QAccessible::Alert);
  set_words(labels_.instruction, QString::fromStdString(shown.instruction),
            QAccessible::NameChanged);
  set_words(labels_.distance, QString::fromStdString(shown.distance), QAccessible::NameChanged);
  set_words(labels_.speed, shown.speed ? number(*shown.speed, 1, "m/s") : QString(),
            QAccessible::NameChanged);
  const int seconds = static_cast<int>(shown.clock.value_or(0.0));
  set_words(labels_.clock,
            shown.clock
                ? QString("%1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QLatin1Char('0'))
                : QString(),
            QAccessible::NameChanged);
}

}  // namespace navvi_rviz::plugin
