glint_test(sgp4)
glint_test(primitives)
glint_test(model)
glint_test(attitude)
glint_test(hinge)
glint_test(orbit)
glint_test(brdf)
glint_test(brdf_properties)
glint_test(fastmath)

# The installed tree, as another project sees it.
add_test(NAME install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install/run.sh ${PROJECT_BINARY_DIR}
    ${PROJECT_VERSION} ${CMAKE_C_COMPILER} ${CMAKE_CXX_COMPILER} ${CMAKE_INSTALL_LIBDIR}
    ${BUILD_SHARED_LIBS} "${GLINT_SANITIZE}")
