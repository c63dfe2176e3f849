// The help texts, made from the declarations of the verbs. docs/bn.md holds them too (scripts/manual).

#pragma once

#include <string>
#include <vector>

#include "tools/verb.h"

namespace bn::tools {

/// bn --help
std::string overview_help(const std::vector<Verb>& verbs, const Arguments& globals);
/// bn noise --help: the methods of a group.
std::string group_help(const std::string& group, const std::vector<Verb>& verbs);
/// bn bake --help
std::string verb_help(const Verb& verb, const Arguments& globals);
/// bn-inspector --help: of a program without verbs, whose arguments are those of `program`.
std::string program_help(const Verb& program);
/// bn help --all: everything above as Markdown, without repeating what all verbs share.
std::string manual(const std::vector<Verb>& verbs, const Arguments& globals);

}  // namespace bn::tools
