// Makes one entry and writes its files.

#pragma once

#include <functional>
#include <vector>

#include "bake/output_files.h"
#include "bn/bake.h"

namespace bn::baking {

using OnFile = std::function<void(const FileRecord&)>;

/// Output i goes to files[i].
JobRecord write_entry(const Entry& entry, const std::vector<Input>& inputs,
                      const std::vector<OutputFile>& files, const Execution& execution,
                      const OnFile& on_file);

}  // namespace bn::baking
