# architecture_violations(<variable> <root>): one line for every broken rule.

# The rooms of the diagnosis stand one upon the other: observe, fit, locate, search, drive; judge and show see all.
set(beside_diagnose "common/ host/session/ host/statistics/ host/parallel.hpp")
set(below_drive "host/diagnose/observe/ host/diagnose/fit/ host/diagnose/locate/ host/diagnose/search/")

# folder | what it may include. The first folder that fits a file counts.
set(include_rules
  "firmware/main.cpp|common/ hal/ firmware/"
  "common/|common/"
  "hal/interface/|common/ hal/interface/"
  "hal/|common/ hal/"
  "firmware/|common/ hal/interface/ firmware/"
  "host/diagnose/observe/|${beside_diagnose} host/diagnose/observe/"
  "host/diagnose/fit/|${beside_diagnose} host/diagnose/observe/ host/diagnose/fit/"
  "host/diagnose/locate/|${beside_diagnose} host/diagnose/observe/ host/diagnose/fit/ host/diagnose/locate/"
  "host/diagnose/search/|${beside_diagnose} ${below_drive}"
  "host/diagnose/drive/|${beside_diagnose} ${below_drive} host/diagnose/drive/"
  "host/|common/ host/"
  "tests/blind/cart|tests/blind/"
  "tests/blind/concealed|tests/blind/"
  "tests/blind/battery|tests/blind/ host/session/"
  "tests/|common/ hal/ firmware/ host/ tests/"
  "tools/|common/ hal/ firmware/ host/ tools/")
set(most_lines 400)
set(top_level
  common hal firmware host tests tools build
  CMakeLists.txt CMakePresets.json README.md CHANGELOG.md LICENSE)

function(starts_with_one_of result text prefixes)
  set(${result} FALSE PARENT_SCOPE)
  foreach(prefix IN LISTS prefixes)
    string(FIND "${text}" "${prefix}" at)
    if(at EQUAL 0)
      set(${result} TRUE PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

function(include_violations result root file)
  set(found)
  foreach(rule IN LISTS include_rules)
    string(REGEX REPLACE "\\|.*" "" folder "${rule}")
    starts_with_one_of(fits "${file}" "${folder}")
    if(fits)
      string(REGEX REPLACE ".*\\|" "" allowed "${rule}")
      break()
    endif()
  endforeach()
  string(REPLACE " " ";" allowed "${allowed}")
  file(STRINGS ${root}/${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]+\"")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE ".*\"([^\"]*)\".*" "\\1" included "${line}")
    starts_with_one_of(ok "${included}" "${allowed}")
    if(NOT ok)
      string(REPLACE ";" " " names "${allowed}")
      list(APPEND found "${file}: includes \"${included}\", allowed from the repository root: ${names}")
    endif()
    # Two backends of the same interface know nothing of each other.
    if((file MATCHES "^hal/sim/" AND included MATCHES "^hal/linux/") OR (file MATCHES "^hal/linux/" AND included MATCHES "^hal/sim/"))
      list(APPEND found "${file}: includes \"${included}\" of the other backend")
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

function(architecture_violations result root)
  set(found)
  file(GLOB_RECURSE sources RELATIVE ${root}
    ${root}/common/* ${root}/hal/* ${root}/firmware/* ${root}/host/* ${root}/tests/* ${root}/tools/*)
  foreach(file IN LISTS sources)
    if(file MATCHES "\\.(cpp|hpp|c|h)$")
      include_violations(broken ${root} ${file})
      list(APPEND found ${broken})
    endif()
    if(file MATCHES "\\.(cpp|hpp|c|h|js|css|cmake|sh)$")
      # Semicolons and brackets would be taken for list separators: count the line ends in hexadecimal.
      file(READ ${root}/${file} text HEX)
      string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\1 " text "${text}")
      string(REGEX MATCHALL "0a " line_ends "${text}")
      list(LENGTH line_ends lines)
      if(lines GREATER most_lines)
        list(APPEND found "${file}: ${lines} lines, at most ${most_lines}: more than one idea")
      endif()
    endif()
  endforeach()
  file(GLOB entries RELATIVE ${root} ${root}/*)
  foreach(entry IN LISTS entries)
    if(NOT entry IN_LIST top_level AND NOT entry MATCHES "^\\.")
      list(APPEND found "${entry}: no place for it at the top (see rules.cmake)")
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()
