// Makes docs/operations, a page for each operation, and the pictures of the guides, from the list of operations,
// their examples and their headers; or checks that what is there is what would be made.
//   azulejo_reference make|check COMMAND SOURCE FOLDER
//     COMMAND  the program azulejo, with azulejos beside it
//     SOURCE   the folder of the project
//     FOLDER   to work in
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "azulejo/operations.h"
#include "book.h"
#include "groups.h"
#include "guide.h"
#include "page.h"
#include "samples.h"

namespace azulejo::reference {
namespace {

/// Pages of docs/ whose commands are run; their pictures lie in docs/pictures, in a folder of the page's name.
constexpr std::array kGuides{"charts",   "curves-and-surfaces", "drawing", "images", "meshes",
                             "polygons", "transformations",     "viewing"};

bool make(Book& book, const std::filesystem::path& command, const std::string& source) {
  for (const std::string& fault : faults_of_groups()) book.add_fault(fault);
  make_samples(book, (command.parent_path() / "azulejos").string());
  for (const Operation* operation : operations()) add_page(book, *operation, source);
  add_index(book);
  std::vector<std::string> folders{"operations", "operations/pictures"};
  for (const std::string guide : kGuides) {
    add_guide(book, guide + ".md", command.string());
    folders.push_back("pictures/" + guide);
  }
  return book.finish(folders);
}

}  // namespace
}  // namespace azulejo::reference

int main(int count, char** words) {
  const std::string what = count == 5 ? words[1] : "";
  if (what != "make" && what != "check") {
    fmt::print(stderr, "usage: azulejo_reference make|check COMMAND SOURCE FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path command = std::filesystem::absolute(words[2]);
    const std::filesystem::path source = std::filesystem::absolute(words[3]);
    const std::filesystem::path folder = std::filesystem::absolute(words[4]) / "work";
    std::filesystem::remove_all(folder);  // nothing that was made before may pass for a result
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
    azulejo::reference::Book book((source / "docs").lexically_normal().string(), what == "make");
    return azulejo::reference::make(book, command, source.lexically_normal().string()) ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "azulejo_reference: {}\n", error.what());
    return 1;
  }
}
