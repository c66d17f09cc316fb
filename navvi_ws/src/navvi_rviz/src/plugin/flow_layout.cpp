#include "plugin/flow_layout.hpp"

#include <algorithm>

namespace navvi_rviz::plugin {

FlowLayout::~FlowLayout() { qDeleteAll(items_); }

QLayoutItem* FlowLayout::takeAt(int index) {
  return index >= 0 && index < count() ? items_.takeAt(index) : nullptr;
}

QList<FlowLayout::Row> FlowLayout::rows(int width) const {
  QList<Row> rows;
  int left = 0;  // px
  for (QLayoutItem* item : items_) {
    if (item->isEmpty()) continue;
    const int wide = item->sizeHint().width();
    if (rows.isEmpty() || left < wide) {
      rows.append(Row());
      left = width;
    }
    rows.last().append(item);
    left -= wide + spacing();
  }
  return rows;
}

int FlowLayout::row_height(const Row& row) const {
  int height = 0;
  for (const QLayoutItem* item : row) height = std::max(height, item->sizeHint().height());
  return height;
}

int FlowLayout::heightForWidth(int width) const {
  int height = -spacing();
  for (const Row& row : rows(width)) height += row_height(row) + spacing();
  return std::max(0, height);
}

void FlowLayout::setGeometry(const QRect& rect) {
  QLayout::setGeometry(rect);
  int top = rect.top();
  for (const Row& row : rows(rect.width())) {
    int spare = rect.width() + spacing();
    for (const QLayoutItem* item : row) spare -= item->sizeHint().width() + spacing();
    const int height = row_height(row), more = std::max(0, spare) / static_cast<int>(row.size());
    int left = rect.left();
    for (QLayoutItem* item : row) {
      const int wide = std::min(rect.width(), item->sizeHint().width() + more);
      item->setGeometry({left, top, wide, height});
      left += wide + spacing();
    }
    top += height + spacing();
  }
}

QSize FlowLayout::minimumSize() const {
  QSize size;
  for (const QLayoutItem* item : items_) size = size.expandedTo(item->minimumSize());
  return size;
}

}  // namespace navvi_rviz::plugin
