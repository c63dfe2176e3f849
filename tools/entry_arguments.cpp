#include "tools/entry_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "bn/error.h"

namespace bn::tools {
namespace {

std::string placeholder_of(const Option& option) {
  switch (option.type) {
    case OptionType::boolean:
      return "true|false";
    case OptionType::integer:
      return "N";
    case OptionType::real:
      return option.percent ? "PERCENT" : "NUMBER";
    case OptionType::text:
      return option.names_file ? "FILE" : "TEXT";
    case OptionType::choice:
      return fmt::format("{}", fmt::join(option.words, "|"));
    case OptionType::measured:
      return "FILTER";
    case OptionType::size:
      return "WIDTHxHEIGHT";
    case OptionType::shape:
      return "WIDTHxHEIGHTxDEPTH";
    case OptionType::offset:
      return option.unset_word.empty() ? "X,Y" : "X,Y|" + option.unset_word;
    case OptionType::integers:
      return "N,N...";
  }
  return "";
}

/// Ranges in the words of a command line, which has no brackets.
std::string allowed_of(const Option& option) {
  const auto whole = [&] {
    Option one = option;
    one.type = OptionType::integer;
    return allowed_text(one);
  };
  switch (option.type) {
    case OptionType::boolean:
    case OptionType::text:
    case OptionType::choice:
      return "";
    case OptionType::measured:
      return allowed_text(option);
    case OptionType::size:
      return fmt::format("each {} {}; one number is a square", whole(), option.unit);
    case OptionType::shape:
      return fmt::format("each {} {}; without a depth one slice, one number is a square", whole(),
                         option.unit);
    case OptionType::offset:
      return "two whole numbers" + (option.unset_word.empty() ? "" : ", or " + option.unset_word);
    case OptionType::integers:
      return fmt::format("1..{} whole numbers, each {}", option.most_elements, whole());
    case OptionType::real:
      if (option.percent) return fmt::format("{}%..{}%", option.least_real * 100.0, option.most_real * 100.0);
      [[fallthrough]];
    case OptionType::integer:
      return option.unit.empty() ? allowed_text(option) : allowed_text(option) + " " + option.unit;
  }
  return "";
}

/// The value that a flag's text means, with lists in the words of a command line where it is refused.
Value typed_value(const Option& option, std::string_view text, std::string_view flag) {
  try {
    return value_from_text(option, text, flag);
  } catch (const Error& error) {
    const bool is_list = option.type == OptionType::size || option.type == OptionType::shape ||
                         option.type == OptionType::offset || option.type == OptionType::integers;
    if (!is_list) throw;
    ErrorInfo info = error.info();
    info.limit = placeholder_of(option) + ", " + allowed_of(option);
    throw Error(std::move(info));
  }
}

/// A condition in the words of recipes, method = "anneal", as a command line has it: --method anneal.
std::string in_flags(std::string condition) {
  // Several are joined by "and".
  if (const std::size_t at = condition.find(" and "); at != std::string::npos)
    return in_flags(condition.substr(0, at)) + " and " + in_flags(condition.substr(at + 5));
  if (const std::size_t at = condition.find(" = "); at != std::string::npos) {
    condition = "--" + condition.substr(0, at) + " " + condition.substr(at + 3);
    std::erase(condition, '"');
  }
  return condition;
}

std::string help_of(const Option& option) {
  std::string help = option.help;
  // The heading says so; and the command always has an image.
  if (option.needs.starts_with("method") || option.needs.starts_with("image")) return help;
  if (!option.needs.empty()) help += fmt::format(" Only with {}.", in_flags(option.needs));
  return help;
}

Argument argument_of(const Option& option) {
  const bool is_boolean = option.type == OptionType::boolean;
  Argument argument{.name = flag_of(option),
                    .short_name = "",
                    .placeholder = placeholder_of(option),
                    .help = help_of(option),
                    .allowed = allowed_of(option),
                    .initial = text_from_value(option, option.get()),
                    .choices = option.words};
  if (argument.initial.empty()) argument.initial = option.unset_help;
  if (is_boolean) argument.choices = {"true", "false"};
  if (!option.unset_word.empty()) argument.choices = {option.unset_word};
  if (!argument.choices.empty()) argument.completion = Completion::choice;
  if (option.type == OptionType::choice && !option.needs.empty() && option.words.size() > 4) {
    argument.placeholder = "NAME";
    argument.allowed = fmt::format("{}", fmt::join(option.words, ", "));
  }
  if (option.needs.starts_with("method = \"")) {
    const std::size_t from = std::string_view("method = \"").size();
    argument.group = "With --method " + option.needs.substr(from, option.needs.find('"', from) - from);
  }
  return argument;
}

/// The file that an entry is made from, which is an argument without a name; further ones have flags.
const Option* first_file(const Options& options) {
  for (const Option& option : options.list()) {
    if (option.names_file) return &option;
  }
  return nullptr;
}

}  // namespace

EntryArguments::EntryArguments(const Kind& kind) : entry_(kind.make()), options_(entry_->options()) {
  entry_->name = kind.table;
}

Argument EntryArguments::flag_for(const Option& option) {
  Argument argument = argument_of(option);
  argument.assign = [this, key = option.key, flag = argument.name](std::string_view text) {
    assign(key, text, flag);
  };
  return argument;
}

Argument EntryArguments::output_flag_for(const Option& option) {
  Argument argument = argument_of(option);
  if (!option.unset_help.empty()) argument.initial = option.unset_help;
  argument.assign = [this, key = option.key, option, flag = argument.name](std::string_view text) {
    typed_value(option, text, flag);  // refused at once; set when the path is known
    output_texts_.emplace_back(key, text);
  };
  return argument;
}

void EntryArguments::declare(Arguments& arguments) {
  for (const Option& option : options_.list()) {
    // A choice of one word is none.
    if (option.recipe_only || (option.type == OptionType::choice && option.words.size() < 2)) continue;
    Argument argument = flag_for(option);
    if (option.names_file && &option == first_file(options_)) {
      argument.name = option.key;
      std::transform(argument.name.begin(), argument.name.end(), argument.name.begin(),
                     [](unsigned char c) { return std::toupper(c); });
      argument.placeholder = argument.name;
      argument.initial.clear();
      argument.required = true;
      argument.completion = Completion::file;
      argument.assign = [this, key = option.key, name = argument.name](std::string_view text) {
        assign(key, text, name);
      };
    }
    arguments.add(std::move(argument));
  }
  entry_->add_output();
  const Options of_output = entry_->output_options(0);
  for (const Option& option : of_output.list()) {
    if (!option.recipe_only) arguments.add(output_flag_for(option));
  }
}

void EntryArguments::declare_some(Arguments& arguments, const std::vector<std::string>& keys,
                                  const std::string& heading) {
  if (entry_->output_count() == 0) entry_->add_output();
  Options of_output = entry_->output_options(0);
  for (const std::string& key : keys) {
    const Option* const option = options_.find(key);
    arguments.add(option != nullptr ? flag_for(*option) : output_flag_for(*of_output.find(key)));
    arguments.in_group(heading);
  }
}

void EntryArguments::assign(const std::string& key, std::string_view text, std::string_view flag) {
  Option& option = *options_.find(key);
  if (option.names_file) check_path_word(text, flag);
  option.set(typed_value(option, text, flag));
  given_.push_back(key);
}

bool EntryArguments::was_given(const std::string& key) const {
  return std::find(given_.begin(), given_.end(), key) != given_.end();
}

void EntryArguments::check() const {
  const auto complain = [&](std::string_view key, std::string problem, std::string limit,
                            std::string remedy) {
    const Option* option = const_cast<Options&>(options_).find(key);
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::move(problem),
                 .where = option && !option->names_file ? flag_of(*option) : std::string(key),
                 .limit = std::move(limit),
                 .remedy = std::move(remedy)});
  };
  for (const Option& option : options_.list()) {
    if (!was_given(option.key)) continue;
    if (!option.applies())
      complain(option.key, "does not apply", "only with " + in_flags(option.needs), "leave it out");
    for (const std::string& other : option.not_beside) {
      if (was_given(other))
        complain(option.key, "given beside --" + other, "one of the two", "leave one out");
    }
  }
  entry_->check(complain);
}

Entry& EntryArguments::finish(const std::string& path) {
  check();
  if (path.empty()) {
    entry_->drop_outputs();  // the one that declare() made
    return *entry_;
  }
  return with_output(path);
}

Entry& EntryArguments::with_output(const std::string& path) {
  entry_->output_path(0) = path;
  entry_->default_output(0);
  Options of_output = entry_->output_options(0);
  for (const auto& [key, text] : output_texts_) {
    Option& option = *of_output.find(key);
    option.set(typed_value(option, text, flag_of(option)));
  }
  return *entry_;
}

Json EntryArguments::to_json() const {
  Json json = Json::object();
  const auto add = [&json](const Options& options) {
    for (const Option& option : options.list()) {
      if (!option.applies() || option.recipe_only || &option == first_file(options)) continue;
      if (option.type == OptionType::choice && option.words.size() < 2) continue;
      std::visit(
          [&](const auto& held) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
              json[option.key] = held;
          },
          option.get());
    }
  };
  add(options_);
  if (entry_->output_count() > 0) add(output_options_of(*entry_, 0));
  return json;
}

}  // namespace bn::tools
