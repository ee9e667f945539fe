#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace cairn::lab {

/// The program `cairn-lab`: runs a command line (without the program's name) and gives the exit
/// status, as the footer of --help lists them.
int run_lab(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace cairn::lab
