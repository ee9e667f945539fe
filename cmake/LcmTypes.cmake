# LCM for CMake >= 3.16, on Debian's 1.3.1 (no CMake package) and on LCM >= 1.4 (find_package(lcm)).
#
# Gives:   lcm::api                   link target of the C / C++ library
#          lcm_types(<target> PACKAGE <p> DIR <dir> TYPES <a_t> <b_t> ... [C] [JAR] [PYTHON])
#              <target>      INTERFACE library of the generated C++ headers: #include <p/a_t.hpp>
#              <target>_c    with C: static library of the C types, #include <p_a_t.h>
#              <target>_jar  with JAR: ${CMAKE_BINARY_DIR}/share/java/<target>.jar, for lcm-spy
#              <target>_py   with PYTHON: ${CMAKE_BINARY_DIR}/python/<p>/*.py
# Rule: one struct per file, named like the file; every file says "package <p>;".
include_guard(GLOBAL)

if(NOT TARGET lcm::api)
  add_library(lcm::api INTERFACE IMPORTED GLOBAL)
  find_package(lcm CONFIG QUIET)                    # 1.4 and newer: targets lcm, lcm-gen
  if(lcm_FOUND)
    target_link_libraries(lcm::api INTERFACE lcm)
    set(LCM_GEN_COMMAND $<TARGET_FILE:lcm-gen>)
    if(TARGET lcm-java)
      get_target_property(_jar lcm-java JAR_FILE)
      get_filename_component(_jar ${_jar} DIRECTORY)
    endif()
    message(STATUS "LCM ${LCM_VERSION} (CMake package)")
  else()                                            # 1.3.1: plain files. Not pkg-config: lcm.pc
    find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp REQUIRED)      # needs libglib2.0-dev, the headers do not
    find_library(LCM_LIBRARY lcm REQUIRED)
    find_program(LCM_GEN lcm-gen REQUIRED)
    target_include_directories(lcm::api SYSTEM INTERFACE ${LCM_INCLUDE_DIR})
    target_link_libraries(lcm::api INTERFACE ${LCM_LIBRARY})
    set(LCM_GEN_COMMAND ${LCM_GEN})
    file(STRINGS ${LCM_INCLUDE_DIR}/lcm/lcm.h _v REGEX "define LCM_(MAJOR|MINOR|MICRO)_VERSION")
    string(REGEX REPLACE "[^0-9;]" "" _v "${_v}")
    string(REPLACE ";" "." LCM_VERSION "${_v}")
    message(STATUS "LCM ${LCM_VERSION} (${LCM_LIBRARY})")
  endif()
  set(LCM_GEN_COMMAND ${LCM_GEN_COMMAND} CACHE INTERNAL "")
  find_file(LCM_JAR lcm.jar HINTS ${_jar} ${LCM_INCLUDE_DIR}/../share/java PATHS /usr/share/java /usr/local/share/java
            PATH_SUFFIXES share/java)
endif()

function(lcm_types target)
  cmake_parse_arguments(PARSE_ARGV 1 A "C;JAR;PYTHON" "PACKAGE;DIR" "TYPES")
  get_filename_component(dir ${A_DIR} ABSOLUTE)
  set(gen ${CMAKE_CURRENT_BINARY_DIR}/lcmgen-${target})
  set(files) 
  set(headers)
  foreach(t IN LISTS A_TYPES)
    set(f ${dir}/${t}.lcm)
    # a wrong package or struct name would give a header ninja never finds: say it at configure time
    file(READ ${f} text)
    string(REGEX MATCHALL "(^|\n)struct +[A-Za-z0-9_]+" structs "${text}")
    if(NOT text MATCHES "(^|\n)package +${A_PACKAGE} *;" OR NOT "${structs}" MATCHES "^\n?struct +${t}$")
      message(FATAL_ERROR "${f}: expected 'package ${A_PACKAGE};' and one 'struct ${t}'")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${f})
    add_custom_command(
      OUTPUT ${gen}/cpp/${A_PACKAGE}/${t}.hpp
      COMMAND ${LCM_GEN_COMMAND} --cpp --cpp-std=c++11 --cpp-hpath ${gen}/cpp ${f}
      DEPENDS ${f} COMMENT "lcm-gen ${A_PACKAGE}.${t}" VERBATIM)
    list(APPEND files ${f})
    list(APPEND headers ${gen}/cpp/${A_PACKAGE}/${t}.hpp)
  endforeach()
  file(MAKE_DIRECTORY ${gen}/cpp)
  add_custom_target(${target}_headers DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)                   # headers exist before any user compiles
  target_include_directories(${target} SYSTEM INTERFACE ${gen}/cpp)  # SYSTEM: old-style casts in them
  target_link_libraries(${target} INTERFACE lcm::api)

  if(A_C)
    set(csrc)
    foreach(t IN LISTS A_TYPES)
      set(b ${gen}/c/${A_PACKAGE}_${t})
      add_custom_command(
        OUTPUT ${b}.c ${b}.h
        COMMAND ${LCM_GEN_COMMAND} --c --c-no-pubsub --c-cpath ${gen}/c --c-hpath ${gen}/c ${dir}/${t}.lcm
        DEPENDS ${dir}/${t}.lcm COMMENT "lcm-gen (C) ${A_PACKAGE}.${t}" VERBATIM)
      list(APPEND csrc ${b}.c ${b}.h)
    endforeach()
    file(MAKE_DIRECTORY ${gen}/c)
    add_library(${target}_c STATIC ${csrc})
    target_include_directories(${target}_c SYSTEM PUBLIC ${gen}/c)
    target_link_libraries(${target}_c PUBLIC lcm::api)
    set_target_properties(${target}_c PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()

  if(A_JAR)
    find_package(Java 1.8 QUIET COMPONENTS Development)
    if(Java_FOUND AND LCM_JAR)
      set(jar ${CMAKE_BINARY_DIR}/share/java/${target}.jar)
      # one command for all: javac wants the types together
      add_custom_command(
        OUTPUT ${jar}
        COMMAND ${CMAKE_COMMAND} -E rm -rf ${gen}/java ${gen}/classes
        COMMAND ${CMAKE_COMMAND} -E make_directory ${gen}/java ${gen}/classes ${CMAKE_BINARY_DIR}/share/java
        COMMAND ${LCM_GEN_COMMAND} --java --jpath ${gen}/java ${files}
        COMMAND ${Java_JAVAC_EXECUTABLE} -nowarn -encoding UTF-8 --release 8 -Xlint:-options -cp ${LCM_JAR} -d ${gen}/classes
                ${gen}/java/${A_PACKAGE}/*.java
        COMMAND ${Java_JAR_EXECUTABLE} cf ${jar} -C ${gen}/classes .
        DEPENDS ${files} COMMENT "${target}.jar")     # not VERBATIM: the shell expands *.java
      add_custom_target(${target}_jar ALL DEPENDS ${jar})
    else()
      message(STATUS "${target}: no jar (Java development kit or lcm.jar not found)")
    endif()
  endif()

  if(A_PYTHON)  # one command for all: in 1.3.1 every lcm-gen run appends to the package's __init__.py
    set(py ${CMAKE_BINARY_DIR}/python)
    add_custom_command(
      OUTPUT ${py}/${A_PACKAGE}/__init__.py
      COMMAND ${CMAKE_COMMAND} -E rm -rf ${py}/${A_PACKAGE}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${py}
      COMMAND ${LCM_GEN_COMMAND} --python --ppath ${py} ${files}
      DEPENDS ${files} COMMENT "python ${A_PACKAGE}" VERBATIM)
    add_custom_target(${target}_py ALL DEPENDS ${py}/${A_PACKAGE}/__init__.py)
  endif()
endfunction()
