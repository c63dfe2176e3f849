// The flags of a kind of texture, from the options that it declares.

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bn/bake.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {

/// An entry that a command line fills in. Keep it for as long as its arguments.
class EntryArguments {
 public:
  explicit EntryArguments(const Kind& kind);

  /// Adds an argument for each option: files that are read are positional, the rest flags.
  void declare(Arguments& arguments);
  /// Adds flags for these options alone, under a heading of their own.
  void declare_some(Arguments& arguments, const std::vector<std::string>& keys, const std::string& heading);
  /// Sets what a flag of another name means: `text` for the option `key`.
  void assign(const std::string& key, std::string_view text, std::string_view flag);

  /// The entry with one output, or none where `path` is empty. Errors: invalid_input (options that do not fit
  /// together).
  Entry& finish(const std::string& path);
  /// The entry with one output, without looking whether its options fit together.
  Entry& with_output(const std::string& path);
  Entry& entry() { return *entry_; }
  bool was_given(const std::string& key) const;

  /// The options that apply, and those of the output, by their keys.
  Json to_json() const;

 private:
  void check() const;
  Argument flag_for(const Option& option);
  Argument output_flag_for(const Option& option);

  std::shared_ptr<Entry> entry_;
  Options options_;
  std::vector<std::string> given_;  ///< keys
  /// Options of the output wait until its path is known, as their defaults may depend on it.
  std::vector<std::pair<std::string, std::string>> output_texts_;
};

}  // namespace bn::tools
