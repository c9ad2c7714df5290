# Found by find_package(cutbench): the libraries that the installed ones need, and these themselves.
include(CMakeFindDependencyMacro)
find_dependency(nlohmann_json)
find_dependency(tomlplusplus)
find_dependency(Eigen3 3.4 NO_MODULE)
include("${CMAKE_CURRENT_LIST_DIR}/cutbench_targets.cmake")
