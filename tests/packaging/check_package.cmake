# Makes the Debian package and looks inside: everything in its place, every library it links to a dependency.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CPACK} -G DEB --config ${CONFIG} -B ${OUT} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB packages ${OUT}/*.deb)
list(LENGTH packages count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "one package expected, ${count} made")
endif()
execute_process(COMMAND dpkg-deb --contents ${packages} OUTPUT_VARIABLE contents COMMAND_ERROR_IS_FATAL ANY)
foreach(path
    bin/cartwright bin/cartwrightd lib/systemd/system/cartwrightd.service share/bash-completion/completions/cartwright
    share/doc/cartwright/copyright share/doc/cartwright/examples/simulated.toml share/doc/cartwright/examples/cart.toml
    share/doc/cartwright/examples/maps/emps.toml share/man/man1/cartwright.1 share/man/man5/cartwright-model.5
    share/man/man5/cartwright-registers.5 share/man/man5/cartwright-session.5 share/man/man8/cartwrightd.8)
  if(NOT contents MATCHES " [1-9][0-9]+ [^\n]* \\./usr/${path}\n")
    message(SEND_ERROR "not in the package, or empty: /usr/${path}")
  endif()
endforeach()
execute_process(COMMAND dpkg-deb --field ${packages} Depends OUTPUT_VARIABLE depends COMMAND_ERROR_IS_FATAL ANY)
foreach(library libc6 libfmt libmatio libmodbus libstdc)
  if(NOT depends MATCHES "${library}")
    message(SEND_ERROR "the package does not depend on ${library}: ${depends}")
  endif()
endforeach()
file(REMOVE_RECURSE ${OUT})
