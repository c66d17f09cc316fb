#pragma once

#include <rviz/panel.h>

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QPushButton>
#include <QStackedWidget>
#include <QTimer>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plugin/flow_layout.hpp"
#include "plugin/keys.hpp"
#include "plugin/preview.hpp"
#include "plugin/reader.hpp"

namespace navvi_rviz::plugin {

/// What the guide says and how the trial stands, in words, below the picture; with a button and a
/// key for each thing that can be asked for. While the spoken menu is open, what it offers and its
/// keys are in the place of what was said. Buttons have names for screen readers. Makes the
/// picture as large as the screen; F2 shows what else RViz has. While a trial runs, closing the
/// window asks the person, as the button that ends it does.
class Panel : public rviz::Panel {
 public:
  Panel();
  void onInitialize() override;
  bool eventFilter(QObject* target, QEvent* event) override;

 private:
  static void name(QLabel* label, const char* name);
  QLabel* add_label(QHBoxLayout* row, const char* name, int stretch);
  /// A button with its key, named in the language of the session.
  struct Named {
    QPushButton* button;
    std::string words;  ///< key of the picture's words
    QKeySequence key;
    std::string spoken;  ///< what the voice calls the key that does the same on the keyboard, as
                         ///< key of the lessons' words; empty: `key` itself
    bool same = false;   ///< it is `key`, whatever the hands are on
  };
  /// \param scope  the key works while this is visible
  QPushButton* add_button(QLayout* row, const Named& named, const std::function<void()>& action,
                          QWidget* scope);
  void name_all();
  void add_questions();
  void add_views();
  void add_menu();
  void show_menu(const QString& words);
  void ask(const std::string& question);
  void request(std::uint8_t what);
  void fill_screen();
  void show_chrome(bool visible);
  /// Beside the picture, the robot's own with what is drawn over it, if there is one.
  void show_camera(QMainWindow& main);
  void fit();
  /// \param said, rest  px, of capital letters in what the guide says, and in all else
  void style(double said, double rest);
  void refresh();

  std::unique_ptr<Reader> reader_;
  Preview preview_;
  Keys keys_{*this};
  ros::NodeHandle node_;
  ros::Publisher questions_, requests_;
  struct {
    QHBoxLayout* numbers;
    FlowLayout *buttons, *menu;
  } rows_;
  struct {
    QLabel *state, *instruction, *distance, *speed, *clock, *menu;
  } labels_;
  QStackedWidget* pages_;  ///< what was said; in its place the spoken menu while it is open
  QPushButton *settings_ = nullptr, *down_ = nullptr;
  QComboBox* visions_ = nullptr;
  QLabel* vision_ = nullptr;
  std::vector<Named> named_;
  QTimer timer_;
  bool chrome_ = false;
  QSize fitted_;  ///< px, of the window, for which the letters were chosen; none: they are to be
};

}  // namespace navvi_rviz::plugin
