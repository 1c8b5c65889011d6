# Writes HEADER with the commit of the repository SOURCE, if it has changed.
cmake_policy(SET CMP0053 NEW)
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=12 --exclude * --dirty=+
  OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define SWELL_COMMIT \"@commit@\"\n" @ONLY)
