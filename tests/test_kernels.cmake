# The kernels' tests, through the native core in float and in double, and the scene compiler's.
add_library(native_scene STATIC native_scene.cpp)
target_link_libraries(native_scene PUBLIC clucida_scene clucida_native GTest::gtest PRIVATE clucida_warnings)
clucida_test(test_kernels_primitives test_kernels_primitives.cpp LIBS native_scene)
clucida_test(test_kernels_booleans test_kernels_booleans.cpp LIBS native_scene)
clucida_test(test_kernels_lenses test_kernels_lenses.cpp LIBS native_scene)
clucida_test(test_kernels_mirrors test_kernels_mirrors.cpp LIBS native_scene)
clucida_test(test_kernels_images test_kernels_images.cpp LIBS native_scene)
clucida_test(test_kernels_light test_kernels_light.cpp LIBS native_scene)
clucida_test(test_kernels_texture test_kernels_texture.cpp LIBS native_scene)
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
foreach(primitive plane sphere cylinder cone paraboloid hyperboloid saddle cuboid ellipsoid)
  add_test(NAME many_rays_${primitive} COMMAND many_rays --rays ${many} --primitive ${primitive})
  add_test(NAME many_rays_${primitive}_in_double
           COMMAND many_rays --rays 200000 --precision double --primitive ${primitive})
  add_test(NAME many_rays_${primitive}_judged_in_113_bits
           COMMAND many_rays --rays 50000 --precision float-in-quad --primitive ${primitive})
  set_tests_properties(many_rays_${primitive} many_rays_${primitive}_in_double
                       many_rays_${primitive}_judged_in_113_bits PROPERTIES PROCESSORS 2 TIMEOUT 900)
endforeach()

find_package(rapidcheck REQUIRED)
clucida_test(test_properties test_properties.cpp LIBS native_scene rapidcheck)
