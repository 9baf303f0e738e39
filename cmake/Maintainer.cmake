# maintainer_of_citation: "NAME <ADDRESS>", the first `contact` of CITATION.cff.
file(READ ${CMAKE_CURRENT_LIST_DIR}/../CITATION.cff citation)
if(NOT citation MATCHES "\ncontact:\n  - name: \"([^\"\n]+)\"\n    email: ([^ \n]+)\n")
  message(FATAL_ERROR "CITATION.cff: no `contact:` with `- name: \"NAME\"` and `email: ADDRESS` on the two lines below it")
endif()
set(maintainer_of_citation "${CMAKE_MATCH_1} <${CMAKE_MATCH_2}>")
