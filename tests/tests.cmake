glint_test(sgp4)
glint_test(tle)
glint_test(primitives)
glint_test(model)
glint_test(attitude)
glint_test(hinge)
glint_test(orbit)
glint_test(clock PkgConfig::ERFA)
glint_test(frames PkgConfig::ERFA)
glint_test(earth PkgConfig::ERFA)
glint_test(eclipse)
glint_test(moon)
glint_test(kepler)
glint_test(brdf)
glint_test(brdf_properties)
glint_test(fastmath)
glint_test(base)
glint_test(csv)
glint_test(vec)
glint_test(cli glint_cli)

# The installed tree, as another project sees it.
add_test(NAME install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install/run.sh ${PROJECT_BINARY_DIR}
    ${PROJECT_VERSION} ${CMAKE_C_COMPILER} ${CMAKE_CXX_COMPILER} ${CMAKE_INSTALL_LIBDIR}
    ${BUILD_SHARED_LIBS} "${GLINT_SANITIZE}")

# The order in which the folders of src/ may include each other.
add_test(NAME rooms COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_rooms.sh ${PROJECT_SOURCE_DIR})

# Every scenario that ships.
add_test(NAME scenarios COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_scenarios.sh
    $<TARGET_FILE:glint_program> ${PROJECT_SOURCE_DIR}/scenarios)

# The program from outside.
add_test(NAME program COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_cli.sh $<TARGET_FILE:glint_program>
    ${PROJECT_SOURCE_DIR} ${PROJECT_VERSION})
