#include "core/toml_document.h"

#include <fmt/format.h>

#include "bn/error.h"
#include "core/diagnostics.h"
#include "core/toml_check.h"

namespace bn::document {

toml::table parse_toml(std::string_view text, const std::string& name) {
  Diagnostics diagnostics(name);
  check_toml(text, diagnostics);
  diagnostics.throw_if_any();
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::string(error.description()),
                 .where = fmt::format("{}:{}", name, error.source().begin.line),
                 .limit = "TOML 1.0",
                 .remedy = ""});
  } catch (const BrokenToml&) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "cannot be read as TOML",
                 .where = name,
                 .limit = "TOML 1.0",
                 .remedy = "look for a bracket, a comma or a value too many or too few"});
  }
}

}  // namespace bn::document
