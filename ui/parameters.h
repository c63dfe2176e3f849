// What the user has set, as names and texts: one function of each view lists its parameters, and undo, the
// session file and scripts all go through it.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bn::ui {

/// Names to values, as text. Two are equal iff the user sees the same settings.
using Settings = std::map<std::string, std::string>;

/// Handed to a view's `void parameters(Parameters&)`, which names every value that the user can change.
/// Saving reads the values, loading writes those that are known and in range; an unknown or bad text leaves
/// the value as it is, so a session file of any age or content is safe.
class Parameters {
 public:
  static Parameters saving(Settings& to) { return Parameters(to, false); }
  static Parameters loading(Settings& from) { return Parameters(from, true); }

  void operator()(const char* name, bool& value);
  void operator()(const char* name, int& value, int low, int high);
  void operator()(const char* name, std::int64_t& value, std::int64_t low, std::int64_t high);
  void operator()(const char* name, double& value, double low, double high);
  /// None is the empty text.
  void operator()(const char* name, std::optional<double>& value);
  void operator()(const char* name, std::optional<int>& value);
  void operator()(const char* name, std::optional<std::int64_t>& value);
  void operator()(const char* name, std::string& value);
  void operator()(const char* name, std::filesystem::path& value);
  bool loading() const { return loading_; }

 private:
  Parameters(Settings& settings, bool loading) : settings_(settings), loading_(loading) {}
  const std::string* text(const char* name) const;
  template <class T>
  void number(const char* name, T& value, T low, T high);
  template <class T>
  void optional_number(const char* name, std::optional<T>& value);

  Settings& settings_;
  bool loading_;
};

/// The parameters as they were, for undo. A change enters when the user lets go of the widget.
class UndoHistory {
 public:
  /// Call with the present settings whenever no widget is held.
  void note(const Settings& now);
  bool can_undo() const { return present_ > 0; }
  bool can_redo() const { return present_ + 1 < states_.size(); }
  /// The settings to go to.
  const Settings& undo() { return states_[--present_]; }
  const Settings& redo() { return states_[++present_]; }

 private:
  static constexpr std::size_t kDepth = 200;
  std::vector<Settings> states_;
  std::size_t present_ = 0;
};

/// Whether all of `text` is a number that T holds, which `value` then is: "12", "1e9", "0.5" of a double.
template <class T>
bool read_number(std::string_view text, T& value);

/// $XDG_STATE_HOME/bn-inspector/session.json, else below ~/.local/state; empty where neither is known.
std::filesystem::path session_file();
/// An absent or damaged file gives no settings: a session is a convenience.
Settings read_session(const std::filesystem::path& path);
/// Makes the folder. Errors: io.
void write_session(const std::filesystem::path& path, const Settings& settings);

}  // namespace bn::ui
