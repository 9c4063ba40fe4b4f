add_library(impulse_options INTERFACE)
target_include_directories(impulse_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(impulse_options INTERFACE -Wall -Wextra -Wconversion -Wshadow -Werror)
# Third-party headers are system headers, so that the warnings above are about our code alone.
target_include_directories(impulse_options SYSTEM INTERFACE
  $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)

option(IMPULSE_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
option(IMPULSE_FUZZERS "Fuzzers of the record readers alone, with clang (tests/fuzz/run)" OFF)
option(IMPULSE_BENCHMARKS "Build bench/" OFF)
if(IMPULSE_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
