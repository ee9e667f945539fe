# One interface target carries the warnings; every target of ours links it privately.
add_library(cairn_build_flags INTERFACE)
add_library(cairn::build_flags ALIAS cairn_build_flags)
target_compile_options(cairn_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference -Wdouble-promotion -Wundef
  $<$<BOOL:${CAIRN_WERROR}>:-Werror>)
