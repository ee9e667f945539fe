#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace cairn::clients {

/// The program `cairn`: runs one subcommand.
/// @param arguments without the program's name
/// @param out data
/// @param err messages for people
/// @return exit status, see ExitCode
int run_cairn(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace cairn::clients
