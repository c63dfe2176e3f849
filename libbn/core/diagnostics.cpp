#include "core/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"

namespace bn::document {

void Diagnostics::add(int line, std::string what, std::string limit, std::string remedy) {
  found_.emplace_back(line, ErrorInfo{.code = ErrorCode::invalid_input,
                                      .what = std::move(what),
                                      .where = line > 0 ? fmt::format("{}:{}", file_, line) : file_,
                                      .limit = std::move(limit),
                                      .remedy = std::move(remedy)});
}

void Diagnostics::throw_if_any() const {
  if (found_.empty()) return;
  auto ordered = found_;
  std::stable_sort(ordered.begin(), ordered.end(), [](auto& a, auto& b) { return a.first < b.first; });
  if (ordered.size() == 1) throw Error(ordered.front().second);
  // The first twenty are enough to work on, and keep a hostile file from flooding a terminal.
  constexpr std::size_t kShown = 20;
  std::string all = fmt::format("{} mistakes", ordered.size());
  for (std::size_t i = 0; i < std::min(kShown, ordered.size()); ++i) {
    all += fmt::format("\n  {}", Error(ordered[i].second).what());
  }
  if (ordered.size() > kShown) all += fmt::format("\n  ... and {} more", ordered.size() - kShown);
  throw Error({.code = ErrorCode::invalid_input, .what = all, .where = file_, .limit = "", .remedy = ""});
}

}  // namespace bn::document
