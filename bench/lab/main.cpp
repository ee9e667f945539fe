#include <iostream>
#include <string>
#include <vector>

#include "bench/lab/program.hpp"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return cairn::lab::run_lab(arguments, std::cout, std::cerr);
}
