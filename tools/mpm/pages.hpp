#pragma once

#include <string>

namespace CLI {
class App;
}

namespace granulaw {

/// Writes into `folder` the manual pages mpm.1 and mpm-COMMAND.1, and completion.bash: the words that tools/package/completion.bash offers. Both come
/// from the options of `app`, which --help prints.
void write_pages(const CLI::App& app, const std::string& folder);

}  // namespace granulaw
