# Fails unless BINARY names a library whose name contains LIBRARY among those it needs (EXPECTED true) or
# names none (EXPECTED false).
execute_process(COMMAND ${READELF} --dynamic --wide ${BINARY}
  OUTPUT_VARIABLE dynamic RESULT_VARIABLE result)
# An output without any needed library means that the question was not answered.
if(NOT result EQUAL 0 OR NOT dynamic MATCHES "NEEDED")
  message(FATAL_ERROR "${READELF} tells nothing about ${BINARY}: ${result}")
endif()

string(REGEX MATCH "NEEDED[^\n]*${LIBRARY}[^\n]*" needed "${dynamic}")
if(EXPECTED AND NOT needed)
  message(FATAL_ERROR "${BINARY} does not link ${LIBRARY}")
elseif(NOT EXPECTED AND needed)
  message(FATAL_ERROR "${BINARY} links ${LIBRARY}: ${needed}")
endif()
