#include "plugin/views.hpp"

#include <rviz/properties/property_tree_widget.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/window_manager_interface.h>

#include <QCoreApplication>
#include <QWidget>

namespace navvi_rviz::plugin {

void choose_view(rviz::DisplayContext& context, const QString& name) {
  rviz::ViewManager& views = *context.getViewManager();
  for (int i = 0; i < views.getNumViews(); ++i)
    if (views.getViewAt(i)->getName().compare(name, Qt::CaseInsensitive) == 0)
      views.setCurrentFrom(views.getViewAt(i));
  // A new view's hidden properties are still to be told to RViz's trees, which fall over them if
  // the next view has taken its place by then.
  if (auto* window = context.getWindowManager())
    for (auto* tree : window->getParentWindow()->findChildren<rviz::PropertyTreeWidget*>())
      QCoreApplication::sendPostedEvents(tree, QEvent::MetaCall);
}

}  // namespace navvi_rviz::plugin
