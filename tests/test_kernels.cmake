# The kernels' tests, and the scene compiler's: through the native core and through OpenCL, in float and in double.
add_library(native_scene STATIC native_scene.cpp machine_native.cpp machine_device.cpp)
target_link_libraries(native_scene
  PUBLIC clucida_scene clucida_native GTest::gtest
  PRIVATE clucida_host clucida_warnings)
target_compile_definitions(native_scene PRIVATE CLUCIDA_TEST_PROBE="${CMAKE_CURRENT_SOURCE_DIR}/probe.cl")

# One executable: each native test registered with CTest alone, those on the device as one entry, for they share a
# program that takes seconds to build.
function(clucida_kernel_test name)
  add_executable(${name} ${name}.cpp)
  target_link_libraries(${name} PRIVATE native_scene ${ARGN} clucida_warnings GTest::gtest GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${CLUCIDA_TEST_OPTIONS})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_FILTER "-*OnDevice.*")
  if(NOT CLUCIDA_SANITIZE)
    add_test(NAME ${name}_on_device COMMAND ${name} --gtest_filter=*OnDevice.*)
    set_tests_properties(${name}_on_device PROPERTIES TIMEOUT 1200 COST 20)
  endif()
endfunction()

clucida_kernel_test(test_kernels_primitives)
clucida_kernel_test(test_kernels_torus)
clucida_kernel_test(test_kernels_booleans)
clucida_kernel_test(test_kernels_lenses)
clucida_kernel_test(test_kernels_mirrors)
clucida_kernel_test(test_kernels_images)
clucida_kernel_test(test_kernels_light)
clucida_kernel_test(test_kernels_texture)
clucida_kernel_test(test_kernels_roots)
clucida_kernel_test(test_kernels_hard_cases)
clucida_test(test_tree test_tree.cpp LIBS clucida_scene)
clucida_test(test_kernels_quick test_kernels_quick.cpp LIBS clucida_native clucida_cli)
clucida_test(test_kernels_packets test_kernels_packets.cpp LIBS native_scene clucida_native clucida_cli)
foreach(name test_kernels_quick test_kernels_packets)
  target_compile_definitions(${name} PRIVATE CLUCIDA_SCENES="${CMAKE_SOURCE_DIR}/scenes")
endforeach()
clucida_test(test_compile_solids test_compile_solids.cpp LIBS native_scene)
clucida_test(test_compile_scene test_compile_scene.cpp LIBS native_scene)

# Many rays against every primitive, judged in a wider type; scripts/nightly takes a hundred times as many.
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
add_executable(many_rays many_rays.cpp)
target_link_libraries(many_rays PRIVATE native_scene clucida_warnings CLI11::CLI11 fmt::fmt nlohmann_json::nlohmann_json
                      Threads::Threads)
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(many 10000000)
else()
  set(many 100000) # unoptimized, or slowed by sanitizers
endif()
math(EXPR many_of_a_kind "${many} * 12 / 100") # of the free quadric there are nine kinds
set(kinds free_ellipsoid one_sheet two_sheets elliptic_cone elliptic_paraboloid hyperbolic_paraboloid elliptic_cylinder
    hyperbolic_cylinder parabolic_cylinder)
foreach(primitive plane sphere cylinder cone paraboloid hyperboloid saddle cuboid ellipsoid torus ${kinds})
  set(rays ${many})
  if(primitive IN_LIST kinds)
    set(rays ${many_of_a_kind})
  endif()
  add_test(NAME many_rays_${primitive} COMMAND many_rays --rays ${rays} --primitive ${primitive})
  add_test(NAME many_rays_${primitive}_in_double
           COMMAND many_rays --rays 200000 --precision double --primitive ${primitive})
  add_test(NAME many_rays_${primitive}_judged_in_113_bits
           COMMAND many_rays --rays 50000 --precision float-in-quad --primitive ${primitive})
  set_tests_properties(many_rays_${primitive} many_rays_${primitive}_in_double
                       many_rays_${primitive}_judged_in_113_bits PROPERTIES PROCESSORS 2 TIMEOUT 900)
endforeach()

# A launch a ray: on the device fewer cases.
find_package(rapidcheck REQUIRED)
clucida_kernel_test(test_properties rapidcheck)
if(NOT CLUCIDA_SANITIZE)
  set_tests_properties(test_properties_on_device PROPERTIES
                     ENVIRONMENT "RC_PARAMS=seed=20160729 max_success=200 max_discard_ratio=50")
endif()
