#pragma once

#include <QLabel>
#include <QLayout>
#include <QList>

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

/// Widgets side by side, in as many rows as they need; each row is filled. No widget is cut as long
/// as the widest has room.
class FlowLayout : public QLayout {
 public:
  FlowLayout() = default;
  ~FlowLayout() override;
  void addItem(QLayoutItem* item) override { items_.append(item); }
  [[nodiscard]] int count() const override { return static_cast<int>(items_.size()); }
  [[nodiscard]] QLayoutItem* itemAt(int index) const override { return items_.value(index); }
  QLayoutItem* takeAt(int index) override;
  [[nodiscard]] Qt::Orientations expandingDirections() const override { return {}; }
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  /// px
  [[nodiscard]] int heightForWidth(int width) const override;
  void setGeometry(const QRect& rect) override;
  [[nodiscard]] QSize sizeHint() const override { return minimumSize(); }
  [[nodiscard]] QSize minimumSize() const override;

 private:
  using Row = QList<QLayoutItem*>;
  [[nodiscard]] QList<Row> rows(int width) const;
  [[nodiscard]] int row_height(const Row& row) const;

  QList<QLayoutItem*> items_;
};

}  // namespace navvi_rviz::plugin
