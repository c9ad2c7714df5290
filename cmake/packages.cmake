# Debian packages, made by experiments/package: cutbench (the program), libcutbench-dev (the libraries),
# python3-cutbench (the Python module).
set(package_contact "The cutbench authors <cutbench@example.org>")
set(package_program cutbench)
set(package_library libcutbench-dev)
set(package_python python3-cutbench)

# What every Debian package has beside its files.
find_program(GZIP gzip REQUIRED)
file(STRINGS ${PROJECT_SOURCE_DIR}/CITATION.cff released REGEX "^date-released: ")
string(REGEX MATCH "[0-9-]+$" released "${released}")
execute_process(COMMAND date -R -u -d ${released} OUTPUT_VARIABLE package_date OUTPUT_STRIP_TRAILING_WHITESPACE)
function(package_documents package component)
  set(folder ${PROJECT_BINARY_DIR}/debian/${package})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/changelog.in ${folder}/changelog @ONLY)
  execute_process(COMMAND ${GZIP} -9nf ${folder}/changelog)
  install(FILES ${folder}/changelog.gz ${PROJECT_SOURCE_DIR}/cmake/debian/copyright
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  if(EXISTS ${PROJECT_SOURCE_DIR}/cmake/debian/${package}.lintian)
    install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/${package}.lintian RENAME ${package}
      DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${component})
  endif()
endfunction()
package_documents(${package_program} program)
package_documents(${package_library} cut)
package_documents(${package_python} python)
# Made of --help by experiments/package.
install(FILES ${PROJECT_BINARY_DIR}/debian/cutbench.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT ${package_contact})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program python cut oracle judge files fem scenes bench command_line)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME ${package_program})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "python3:any")  # for the scripts that draw
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-numpy, python3-matplotlib, python3-pil")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "cut deformable triangle sheets, and compare methods
Runs every method of cutting a deformable sheet on the same meshes and cuts,
judges each result by an oracle that shares no code with it, and simulates
the cut sheet by finite elements.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${package_library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libgmp-dev, libmpfr-dev, libeigen3-dev, libsuitesparse-dev, nlohmann-json3-dev, libtomlplusplus-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "libcgal-dev")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "cut deformable triangle sheets: libraries for C++20
Static libraries, each with what it needs alone: cutting methods, the oracle
that judges a cut, finite elements with solvers, files, and the benchmark.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${package_python})
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-meshio, python3-tqdm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "cut deformable triangle sheets: Python module
Cut, judge, simulate and compare from numpy arrays.")

include(CPack)
cpack_add_component_group(program DESCRIPTION ${CPACK_COMPONENT_PROGRAM_DESCRIPTION})
cpack_add_component_group(library DESCRIPTION ${CPACK_COMPONENT_LIBRARY_DESCRIPTION})
cpack_add_component_group(python DESCRIPTION ${CPACK_COMPONENT_PYTHON_DESCRIPTION})
cpack_add_component(program GROUP program)
cpack_add_component(python GROUP python)
foreach(name cut oracle judge files fem scenes bench command_line)
  cpack_add_component(${name} GROUP library)
endforeach()
