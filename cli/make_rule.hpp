#pragma once

#include <string>
#include <vector>

namespace sdlc::cli {

/// A dependency file as Make and Ninja read it: the targets depend on the files, and each file but
/// the first has an empty rule, so that Make does not stop when one was deleted. Throws UsageError
/// for a name that is empty or has a line break, which neither can read.
std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& files);

}  // namespace sdlc::cli
