// The Run view: choose an image and a schedule, anneal, watch.

#pragma once

namespace bn::ui {

class App;
class Parameters;

class RunView {
 public:
  void draw(App& app);
  /// Every value that the user can change here; see ui/parameters.h.
  void parameters(Parameters& p);
  /// Whether something is going on, so that the window must be drawn again without input.
  bool busy() const { return false; }
};

}  // namespace bn::ui
