# Fails when an object that runs inside a tick refers to operator new, malloc, throw, a mutex, dynamic_cast or stdio.
set(forbidden
  " _Zn[wa]" " _Zd[la]Pv" " (m|c|re)alloc$" " free$" "__cxa_throw" "__cxa_allocate_exception" "__dynamic_cast"
  "pthread_mutex" "pthread_cond" "printf" "puts$" "fwrite" "_ZNSt6thread" "_ZSt.*throw" " nanosleep" "clock_nanosleep")
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} -u ${object} OUTPUT_VARIABLE symbols RESULT_VARIABLE status)
  if(NOT status EQUAL 0 OR symbols STREQUAL "")
    message(FATAL_ERROR "${object}: nm shows nothing")
  endif()
  string(REPLACE "\n" ";" lines "${symbols}")
  foreach(line IN LISTS lines)
    foreach(pattern IN LISTS forbidden)
      if(line MATCHES "${pattern}")
        message(SEND_ERROR "${object}: refers to${line}")
      endif()
    endforeach()
  endforeach()
endforeach()
