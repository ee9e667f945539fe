#include <iostream>
#include <string>
#include <vector>

#include "clients/cairn/program.hpp"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return cairn::clients::run_cairn(arguments, std::cout, std::cerr);
}
