// bn/error.h - floor 0: the one exception type of the library.

#pragma once

#include <stdexcept>
#include <string>

namespace bn {

/// Why something failed. Numbers are permanent and never reused.
enum class ErrorCode : int {
  usage = 1,                ///< a command line that cannot be parsed (tools only)
  io = 2,                   ///< a file or folder could not be read, written, flushed or renamed
  invalid_input = 3,        ///< a value outside its range, or a file whose content is not acceptable
  over_limit = 4,           ///< out of memory, or a request above a stated limit
  verification_failed = 5,  ///< a recomputed figure differs from the recorded one
  cancelled = 6,            ///< stopped through Execution::stop
};

/// The parts of a message. `what` is required; a reader must be able to act on the rest.
struct ErrorInfo {
  ErrorCode code;
  std::string what;    ///< what is wrong, with the offending value
  std::string where;   ///< file:line, path, recipe key or parameter
  std::string limit;   ///< the allowed range or the limit that was met
  std::string remedy;  ///< what to do about it
};

/// The one exception type that libbn throws on purpose.
/// what() reads "where: what (allowed: limit); remedy", leaving out the parts that are empty.
class Error : public std::runtime_error {
 public:
  explicit Error(ErrorInfo info);
  ErrorCode code() const { return info_.code; }
  const ErrorInfo& info() const { return info_; }

 private:
  ErrorInfo info_;
};

}  // namespace bn
