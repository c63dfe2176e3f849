// The windows of the Help menu: all keys, and what this is.

#pragma once

namespace bn::ui {

class Help {
 public:
  enum class Page { none, keys, about };
  void open(Page page) { wanted_ = page; }
  /// Once a frame. While a page is open, what is behind it is dimmed and waits; Escape, F1, a click beside
  /// the page or "Close" ends that.
  void draw();

 private:
  Page wanted_ = Page::none, shown_ = Page::none;
};

}  // namespace bn::ui
