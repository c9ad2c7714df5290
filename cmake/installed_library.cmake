# A library as others find it: installed_library(NAME HEADERS...) makes of the target cutbench_NAME the component NAME of
# the package, cutbench::NAME. HEADERS are folders and files of the source tree.
include(GNUInstallDirs)
set(CUTBENCH_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/cutbench)

function(installed_library name)
  set(target cutbench_${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT ${target} COMPONENT ${name})
  install(EXPORT ${target} NAMESPACE cutbench:: FILE ${target}_targets.cmake DESTINATION ${CUTBENCH_PACKAGE_FOLDER}
    COMPONENT ${name})
  install(CODE "
    set(source \"${PROJECT_SOURCE_DIR}\")
    set(headers \"${ARGN}\")
    set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/cutbench\")
    include(\"${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake\")" COMPONENT ${name})
endfunction()
