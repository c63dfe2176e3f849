#include "bn/error.h"

namespace bn {
namespace {

std::string compose(const ErrorInfo& info) {
  std::string text;
  if (!info.where.empty()) text += info.where + ": ";
  text += info.what;
  if (!info.limit.empty()) text += " (allowed: " + info.limit + ")";
  if (!info.remedy.empty()) text += "; " + info.remedy;
  return text;
}

}  // namespace

Error::Error(ErrorInfo info) : std::runtime_error(compose(info)), info_(std::move(info)) {}

}  // namespace bn
