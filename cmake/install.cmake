# `cmake --install`: header, library, program, CMake package, pkg-config file, manual, completion.
# Everything finds its neighbours by relative paths, so that the tree may be moved.

if(BUILD_SHARED_LIBS)
    file(RELATIVE_PATH GLINT_BIN_TO_LIB /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    set_target_properties(glint_program PROPERTIES INSTALL_RPATH $ORIGIN/${GLINT_BIN_TO_LIB})
endif()
install(TARGETS glint EXPORT glintTargets)
install(TARGETS glint_program)
install(FILES include/glint/glint.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/glint)

# The CMake package: find_package(glint) gives glint::glint.
set(GLINT_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/glint)
install(EXPORT glintTargets NAMESPACE glint:: DESTINATION ${GLINT_PACKAGE_DIR})
if(BUILD_SHARED_LIBS)
    set(GLINT_IS_STATIC OFF)
else()
    set(GLINT_IS_STATIC ON)
endif()
if(embree_FOUND)
    set(GLINT_HAS_EMBREE ON)
else()
    set(GLINT_HAS_EMBREE OFF)
endif()
configure_package_config_file(cmake/glintConfig.cmake.in package/glintConfig.cmake
    INSTALL_DESTINATION ${GLINT_PACKAGE_DIR} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may break what worked.
write_basic_package_version_file(package/glintConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/glintConfig.cmake
    ${PROJECT_BINARY_DIR}/package/glintConfigVersion.cmake DESTINATION ${GLINT_PACKAGE_DIR})

# The pkg-config file; `pkg-config --static` adds what a static libglint needs.
file(RELATIVE_PATH GLINT_PC_TO_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" GLINT_PC_TO_PREFIX ${GLINT_PC_TO_PREFIX})
if(embree_FOUND)
    set(GLINT_EMBREE_LIBS "-lembree3 ") # it has no pkg-config file
endif()
configure_file(cmake/glint.pc.in package/glint.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/glint.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# The manual page and the completion, printed by the program itself.
if(NOT CMAKE_CROSSCOMPILING)
    set(GLINT_MAN ${PROJECT_BINARY_DIR}/generated/glint.1)
    set(GLINT_COMPLETION ${PROJECT_BINARY_DIR}/generated/glint.bash)
    add_custom_command(OUTPUT ${GLINT_MAN} ${GLINT_COMPLETION}
        COMMAND glint_program --man > ${GLINT_MAN}
        COMMAND glint_program --completion bash > ${GLINT_COMPLETION}
        DEPENDS glint_program VERBATIM)
    add_custom_target(glint_pages ALL DEPENDS ${GLINT_MAN} ${GLINT_COMPLETION})
    install(FILES ${GLINT_MAN} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${GLINT_COMPLETION} RENAME glint
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()
