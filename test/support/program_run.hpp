#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace cairn::test {

/// How a program ended, and what it wrote.
struct ProgramRun {
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs a program that is a function of its arguments and of where it writes, in this process.
template <typename Program>
ProgramRun run_program(Program program, const std::vector<std::string>& arguments) {
  std::ostringstream out;
  std::ostringstream err;
  const int status = program(arguments, out, err);
  return {status, out.str(), err.str()};
}

}  // namespace cairn::test
