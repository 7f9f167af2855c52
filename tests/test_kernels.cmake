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
  target_link_libraries(${name} PRIVATE native_scene clucida_warnings GTest::gtest GTest::gtest_main)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_FILTER "-*OnDevice.*")
  add_test(NAME ${name}_on_device COMMAND ${name} --gtest_filter=*OnDevice.*)
  set_tests_properties(${name}_on_device PROPERTIES TIMEOUT 1200)
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
clucida_test(test_compile_solids test_compile_solids.cpp LIBS native_scene)
clucida_test(test_compile_scene test_compile_scene.cpp LIBS native_scene)
