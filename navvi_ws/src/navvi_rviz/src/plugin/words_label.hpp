#pragma once

#include <QLabel>

namespace navvi_rviz::plugin {

/// Words on a fixed number of lines: words that need more have smaller letters, so that nothing is
/// cut and nothing beside it moves.
class WordsLabel : public QLabel {
 public:
  explicit WordsLabel(int lines) : lines_(lines) {}
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  int lines_;
};

}  // namespace navvi_rviz::plugin
