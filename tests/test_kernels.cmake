# The kernels' tests, through the native core in float and in double, and the scene compiler's.
add_library(native_scene STATIC native_scene.cpp)
target_link_libraries(native_scene PUBLIC clucida_scene clucida_native GTest::gtest PRIVATE clucida_warnings)
clucida_test(test_kernels_primitives test_kernels_primitives.cpp LIBS native_scene)
clucida_test(test_kernels_booleans test_kernels_booleans.cpp LIBS native_scene)
clucida_test(test_kernels_lenses test_kernels_lenses.cpp LIBS native_scene)
clucida_test(test_kernels_mirrors test_kernels_mirrors.cpp LIBS native_scene)
