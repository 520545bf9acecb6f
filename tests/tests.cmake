glint_test(sgp4)
glint_test(tle)
glint_test(primitives)
glint_test(revolved)
glint_test(crinkle)
glint_test(curved)
glint_test(mesh)
glint_test(mesh_light)
target_compile_definitions(test_mesh_light PRIVATE SCENARIO_DIR="${PROJECT_SOURCE_DIR}/scenarios")
glint_test(model)
glint_test(polygon)
glint_test(fans)
glint_test(visibility)
glint_test(visibility_pieces)
glint_test(view PkgConfig::CAIRO)
glint_test(attitude)
glint_test(attitude_table)
glint_test(attitude_plan)
glint_test(torque_free)
glint_test(hinge)
glint_test(orbit)
glint_test(clock PkgConfig::ERFA)
glint_test(frames PkgConfig::ERFA)
glint_test(earth PkgConfig::ERFA)
glint_test(eclipse)
glint_test(moon PkgConfig::ERFA)
glint_test(horizon)
glint_test(refraction)
glint_test(eop)
glint_test(kepler)
glint_test(ccsds)
glint_test(oem)
glint_test(positions)
glint_test(omm)
glint_test(orbit_files)
glint_test(brdf)
glint_test(brdf_properties)
glint_test(brdf_threads Threads::Threads)
glint_test(measured)
glint_test(table)
glint_test(dhr)
glint_test(fit)
glint_test(materials)
glint_test(fastmath)
glint_test(base)
glint_test(csv)
glint_test(vec)
glint_test(cli glint_cli)
glint_test(scenario)
glint_test(scenario_model)
glint_test(scenario_errors)
glint_test(model_errors)
glint_test(scenario_files)
glint_test(endtoend)
glint_test(curve)
glint_test(photometry)
glint_test(exposure)
glint_test(shadows)
glint_test(coverage)
glint_test(solar_disc)
glint_test(globe)
glint_test(earthshine)
glint_test(verify)
glint_test(shares)
glint_test(compare)
glint_test(passes)
glint_test(flashes)
glint_test(ephemeris)
glint_test(observers)
glint_test(output)
glint_test(plot)
glint_test(material_api)

# The installed tree, as another project sees it.
add_test(NAME install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install/run.sh ${PROJECT_BINARY_DIR}
    ${PROJECT_VERSION} ${CMAKE_C_COMPILER} ${CMAKE_CXX_COMPILER} ${CMAKE_INSTALL_LIBDIR}
    ${BUILD_SHARED_LIBS} "${GLINT_SANITIZE}")
set_tests_properties(install PROPERTIES ENVIRONMENT "CMAKE_GENERATOR=${CMAKE_GENERATOR}")

# The order in which the folders of src/ may include each other.
add_test(NAME rooms COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_rooms.sh ${PROJECT_SOURCE_DIR})

# What the library shows to the programs that it is linked into; 77: no nm.
if(BUILD_SHARED_LIBS)
    set(GLINT_FORM shared)
elseif(GLINT_CAN_PRELINK)
    set(GLINT_FORM static)
else()
    set(GLINT_FORM open)
endif()
add_test(NAME symbols COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_symbols.sh "${CMAKE_NM}"
    ${CMAKE_C_COMPILER} ${PROJECT_SOURCE_DIR}/include/glint/glint.h ${GLINT_FORM} $<TARGET_FILE:glint>
    $<TARGET_FILE:glint_inside> ${PROJECT_SOURCE_DIR}/cmake/glint.map)
set_tests_properties(symbols PROPERTIES SKIP_RETURN_CODE 77)

# Every scenario that ships.
add_test(NAME scenarios COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_scenarios.sh
    $<TARGET_FILE:glint_program> ${PROJECT_SOURCE_DIR}/scenarios)

# The pages of the reflectance models say what the program says.
add_test(NAME model_pages COMMAND ${PROJECT_SOURCE_DIR}/scripts/model-pages --check
    $<TARGET_FILE:glint_program>)

# The pictures of the founding paper; 77: gnuplot is not there.
add_test(NAME figures COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_figures.sh
    $<TARGET_FILE:glint_program> ${PROJECT_SOURCE_DIR})
set_tests_properties(figures PROPERTIES SKIP_RETURN_CODE 77)

# The program from outside.
add_test(NAME program COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_cli.sh $<TARGET_FILE:glint_program>
    ${PROJECT_SOURCE_DIR} ${PROJECT_VERSION})

# Passes and ephemerides from outside.
add_test(NAME passes_program COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_passes.sh
    $<TARGET_FILE:glint_program> ${PROJECT_SOURCE_DIR}/scenarios)

# The example of every command's --help.
add_test(NAME examples COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_examples.sh
    $<TARGET_FILE:glint_program> ${PROJECT_SOURCE_DIR}/scenarios)

# README.md and docs/: commands, scenarios, keys. The program of docs/api.md is taken out of the page
# and compiled.
glint_test(docs_tables)
target_compile_definitions(test_docs_tables PRIVATE DOCS_DIR="${PROJECT_SOURCE_DIR}/docs")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/api.md)
file(READ ${PROJECT_SOURCE_DIR}/docs/api.md GLINT_API_PAGE)
string(REGEX MATCH "\n```c\n.*\n}\n```\n" GLINT_API_BLOCK "${GLINT_API_PAGE}")
string(REGEX REPLACE "^\n```c\n|```\n$" "" GLINT_API_PROGRAM "${GLINT_API_BLOCK}")
file(CONFIGURE OUTPUT docs_api.c CONTENT "${GLINT_API_PROGRAM}" @ONLY)
add_executable(docs_api ${CMAKE_CURRENT_BINARY_DIR}/docs_api.c)
target_link_libraries(docs_api PRIVATE glint_flags glint)
add_test(NAME docs COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_docs.sh $<TARGET_FILE:glint_program>
    ${PROJECT_SOURCE_DIR} $<TARGET_FILE:docs_api>)

# The known geometries: closed forms as scenarios.
add_test(NAME known COMMAND sh -c "exec \"$1\" verify \"$2\"/known/*.toml" sh
    $<TARGET_FILE:glint_program> ${PROJECT_SOURCE_DIR}/scenarios)

# Tables as astropy reads them. Debian's python3-astropy is known to Debian's python3 alone.
find_program(GLINT_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(GLINT_PYTHON python3)
if(GLINT_PYTHON)
    # The mesh that ships is what its script writes.
    add_test(NAME probe_mesh COMMAND sh -c "\"$1\" \"$2/make-probe.py\" /dev/stdout | cmp - \"$2/probe.obj\"" sh
        ${GLINT_PYTHON} ${PROJECT_SOURCE_DIR}/scenarios/models)
    add_test(NAME ecsv COMMAND ${GLINT_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test_ecsv.py
        $<TARGET_FILE:glint_program> ${CMAKE_CURRENT_SOURCE_DIR}/data)
    # Ephemerides and passes against sgp4, Skyfield and ERFA for Python.
    add_test(NAME astronomy COMMAND ${GLINT_PYTHON}
        ${CMAKE_CURRENT_SOURCE_DIR}/test_astronomy.py $<TARGET_FILE:glint_program>)
    # Earthshine and magnitudes of whole runs against sums by numpy.
    add_test(NAME light COMMAND ${GLINT_PYTHON}
        ${CMAKE_CURRENT_SOURCE_DIR}/test_light.py $<TARGET_FILE:glint_program>)
else()
    add_test(NAME probe_mesh COMMAND sh -c
        "echo 'SKIPPED: the mesh that ships against its script: no python3'; exit 77")
    add_test(NAME ecsv COMMAND sh -c "echo 'SKIPPED: tables read by astropy: no python3'; exit 77")
    add_test(NAME astronomy COMMAND sh -c
        "echo 'SKIPPED: ephemerides against other programs: no python3'; exit 77")
    add_test(NAME light COMMAND sh -c
        "echo 'SKIPPED: light against sums by numpy: no python3'; exit 77")
endif()
set_tests_properties(probe_mesh ecsv astronomy light PROPERTIES SKIP_RETURN_CODE 77)

# Against the sky, and against another study of it; formulas written down a second time. 77: the
# reference data are not there.
foreach(what formulas study cases sky)
    if(GLINT_PYTHON)
        add_test(NAME starlink_${what} COMMAND ${GLINT_PYTHON}
            ${CMAKE_CURRENT_SOURCE_DIR}/validation/starlink_v15.py $<TARGET_FILE:glint_program> ${what})
    else()
        add_test(NAME starlink_${what} COMMAND sh -c "echo 'SKIPPED: starlink ${what}: no python3'; exit 77")
    endif()
    set_tests_properties(starlink_${what} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()

# The numbers of docs/validation.md: some thousands of runs, minutes; `ctest -C long` has it.
if(GLINT_PYTHON)
    add_test(NAME starlink_steps CONFIGURATIONS long COMMAND ${GLINT_PYTHON}
        ${CMAKE_CURRENT_SOURCE_DIR}/validation/starlink_v15.py $<TARGET_FILE:glint_program> steps
        ${PROJECT_SOURCE_DIR}/docs/validation.md)
    set_tests_properties(starlink_steps PROPERTIES SKIP_RETURN_CODE 77)
endif()
