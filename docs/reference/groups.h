#pragma once

#include <span>
#include <string>
#include <vector>

namespace azulejo::reference {

/// Operations that the index lists together.
struct Group {
  const char* title;
  const char* sentence;
  std::vector<std::string> operations;  ///< by name
};

/// In the order of the index. Every operation belongs to one.
std::span<const Group> groups();

/// What is wrong with the groups: operations in none or in several, names that are no operation's.
std::vector<std::string> faults_of_groups();

}  // namespace azulejo::reference
