// What a verb of `bn` is: a name, what its help says, what it accepts, what it does.
//
// Each is declared once, in the file of its name; parsing, --help, docs/bn.md and shell completion are all
// read from the declaration. Verbs compute nothing: they call libbn and print.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/session.h"
#include "tools/values.h"

namespace bn::tools {

/// One option, switch or positional argument.
struct Argument {
  std::string name;         ///< "--size", or "RECIPE" for a positional one
  std::string short_name;   ///< "-o", or empty
  std::string placeholder;  ///< of the value; empty for a switch
  std::string help;         ///< one sentence
  std::string allowed;      ///< the range, as the help shows it
  std::string initial;      ///< the value that holds where none is given, as the help shows it
  bool required = false;
  bool repeats = false;  ///< a positional one that takes all the words that are left
  Completion completion = Completion::none;
  std::vector<std::string> choices = {};
  std::string group = {};  ///< the heading that the help puts it under; empty: "Options"
  bool hidden = false;     ///< an older name, which works and is not shown
  std::function<void(std::string_view text)> assign = {};

  bool is_positional() const { return name.front() != '-'; }
  bool is_switch() const { return placeholder.empty(); }
};

/// The targets given here must outlive the parse; a verb keeps them in what its `run` owns.
class Arguments {
 public:
  /// An argument without a name, always required; positional ones are taken in this order.
  template <class T>
  void positional(std::string name, T& target, const ValueKind<T>& kind, std::string help) {
    add(std::move(name), "", target, kind, std::move(help)).required = true;
    list_.back().placeholder = list_.back().name;
  }
  /// As positional(), but it may be left out.
  template <class T>
  void optional_positional(std::string name, T& target, const ValueKind<T>& kind, std::string help) {
    positional(std::move(name), target, kind, std::move(help));
    list_.back().required = false;
  }
  /// One or more arguments without a name; the last positional ones.
  template <class T>
  void positional_list(std::string name, std::vector<T>& target, const ValueKind<T>& kind, std::string help) {
    optional_list(std::move(name), target, kind, std::move(help));
    list_.back().required = true;
  }
  /// As positional_list(), but there may be none.
  template <class T>
  void optional_list(std::string name, std::vector<T>& target, const ValueKind<T>& kind, std::string help) {
    list_.push_back({.name = name,
                     .short_name = "",
                     .placeholder = name,
                     .help = std::move(help),
                     .allowed = kind.allowed,
                     .initial = "",
                     .repeats = true,
                     .completion = kind.completion,
                     .choices = kind.choices,
                     .assign = [&target, parse = kind.parse, name](std::string_view text) {
                       target.push_back(parse(text, name));
                     }});
  }
  /// "--name VALUE". What `target` holds already is the default that the help shows.
  template <class T>
  void option(std::string name, T& target, const ValueKind<T>& kind, std::string help,
              std::string short_name = "") {
    auto& argument = add(std::move(name), std::move(short_name), target, kind, std::move(help));
    if (kind.show) argument.initial = kind.show(target);
  }
  /// An option without which the verb cannot work.
  template <class T>
  void required_option(std::string name, T& target, const ValueKind<T>& kind, std::string help,
                       std::string short_name = "") {
    add(std::move(name), std::move(short_name), target, kind, std::move(help)).required = true;
  }
  /// A switch: `target` becomes `value` when it is given.
  void flag(std::string name, bool& target, bool value, std::string help, std::string short_name = "") {
    list_.push_back({.name = std::move(name),
                     .short_name = std::move(short_name),
                     .placeholder = "",
                     .help = std::move(help),
                     .allowed = "",
                     .initial = "",
                     .assign = [&target, value](std::string_view) { target = value; }});
  }

  void add(Argument argument) { list_.push_back(std::move(argument)); }
  /// A name that an option had before: it works and is not shown. A switch where `placeholder` is empty.
  void older_name(std::string name, std::string placeholder,
                  std::function<void(std::string_view text)> assign_text) {
    Argument argument;
    argument.name = std::move(name);
    argument.placeholder = std::move(placeholder);
    argument.hidden = true;
    argument.assign = std::move(assign_text);
    add(std::move(argument));
  }
  /// Puts the argument that was added last under a heading of its own in the help.
  void in_group(std::string heading) { list_.back().group = std::move(heading); }

  const std::vector<Argument>& list() const { return list_; }

 private:
  template <class T>
  Argument& add(std::string name, std::string short_name, T& target, const ValueKind<T>& kind,
                std::string help) {
    list_.push_back({.name = name,
                     .short_name = std::move(short_name),
                     .placeholder = kind.placeholder,
                     .help = std::move(help),
                     .allowed = kind.allowed,
                     .initial = "",
                     .completion = kind.completion,
                     .choices = kind.choices,
                     .assign = [&target, parse = kind.parse, name](std::string_view text) {
                       target = parse(text, name);
                     }});
    return list_.back();
  }

  std::vector<Argument> list_;
};

struct Example {
  std::string command;
  std::string purpose;
};

struct Verb {
  std::string name;     ///< one word, or two where the first has several methods: "noise void-and-cluster"
  std::string summary;  ///< one line
  std::vector<Example> examples;
  std::string details;  ///< paragraphs, parted by empty lines
  Arguments arguments = {};
  /// Throws bn::Error on failure; returns on success.
  std::function<void(Session&)> run = {};
};

}  // namespace bn::tools
