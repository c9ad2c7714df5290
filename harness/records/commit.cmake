# Writes OUT, a header with the commit of SOURCE that is built, where it changed since the last time. Without git, or in
# an archive, the commit is empty.
execute_process(COMMAND git -C "${SOURCE}" rev-parse --show-toplevel OUTPUT_VARIABLE top
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(commit "")
set(dirty false)
if(top STREQUAL SOURCE)
  execute_process(COMMAND git -C "${SOURCE}" rev-parse HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND git -C "${SOURCE}" status --porcelain OUTPUT_VARIABLE changes)
  if(NOT changes STREQUAL "")
    set(dirty true)
  endif()
endif()
file(CONFIGURE OUTPUT "${OUT}" CONTENT "#define CUTBENCH_COMMIT \"${commit}\"\n#define CUTBENCH_DIRTY ${dirty}\n")
