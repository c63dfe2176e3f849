// Parts of the toolkit that are loaded only when they are needed, because the libraries they stand on take
// long to start. A module is a shared library of ours that lies beside the program.

#pragma once

#include <string>

namespace bn {

/// The address of `symbol` in the module lib<name>.so, which is loaded at the first call and stays loaded. It
/// is looked for in the folder of the program or library that this code is part of, in the two folders above
/// it, and in lib/bn beside its folder; never in the current folder. Thread safe. Errors: io, with the
/// loader's own words; `purpose` says what the module is for: "reading EXR", `remedy` what to do.
void* module_symbol(const std::string& name, const std::string& symbol, const std::string& purpose,
                    const std::string& remedy);

}  // namespace bn
