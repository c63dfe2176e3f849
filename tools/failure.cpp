#include "tools/failure.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

namespace bn::tools {
namespace {

/// An exception that nobody meant to throw; EX_SOFTWARE of sysexits.h.
constexpr auto kDefect = static_cast<ErrorCode>(70);

}  // namespace

int exit_code_of(ErrorCode code, int signal) {
  switch (code) {
    case ErrorCode::usage:
      return 1;
    case ErrorCode::io:
      return 2;
    case ErrorCode::invalid_input:
      return 3;
    case ErrorCode::over_limit:
      return 4;
    case ErrorCode::verification_failed:
      return 5;
    case ErrorCode::cancelled:
      return 128 + signal;
  }
  return static_cast<int>(kDefect);
}

Error error_in_flight(const std::string& program) {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::filesystem::filesystem_error& error) {
    return Error({.code = ErrorCode::io,
                  .what = error.code().message(),
                  .where = error.path1().string(),
                  .limit = "",
                  .remedy = "check the path and its permissions"});
  } catch (const std::bad_alloc&) {
    return Error({.code = ErrorCode::over_limit,
                  .what = "out of memory",
                  .where = "",
                  .limit = "",
                  .remedy = "ask for less, or use fewer --threads"});
  } catch (const std::length_error&) {
    return Error({.code = ErrorCode::over_limit,
                  .what = "more elements than any memory holds",
                  .where = "",
                  .limit = "",
                  .remedy = "ask for less"});
  } catch (const std::system_error& error) {
    const bool no_resources = error.code() == std::errc::resource_unavailable_try_again ||
                              error.code() == std::errc::not_enough_memory;
    return Error({.code = no_resources ? ErrorCode::over_limit : ErrorCode::io,
                  .what = error.what(),
                  .where = "",
                  .limit = "",
                  .remedy = no_resources ? "use fewer --threads" : ""});
  } catch (const std::exception& defect) {
    return Error({.code = kDefect,
                  .what = fmt::format("a defect in {}: {}", program, defect.what()),
                  .where = "",
                  .limit = "",
                  .remedy = "please report it with the command that shows it"});
  } catch (...) {
    return Error({.code = kDefect,
                  .what = fmt::format("a defect in {}: an exception of no known type", program),
                  .where = "",
                  .limit = "",
                  .remedy = "please report it with the command that shows it"});
  }
}

}  // namespace bn::tools
