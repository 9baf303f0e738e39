# cmake -DNM=nm -DOBJECTS="a.o|b.o" -P weak_symbols.cmake
# Fails if an object file has a weak or unique symbol.
string(REPLACE "|" ";" objects "${OBJECTS}")
execute_process(COMMAND ${NM} -C ${objects} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]* [WVuwv] [^\n]*" weak "${symbols}")
if(weak)
  string(REPLACE ";" "\n" weak "${weak}")
  message(FATAL_ERROR "weak symbols, of which the linker keeps one for all instruction sets:\n${weak}")
endif()
