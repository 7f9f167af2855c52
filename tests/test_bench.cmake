# The oracle's tests: against closed forms and itself; then the kernels' pictures against the oracle's.
find_package(fmt REQUIRED)
function(clucida_oracle_test name)
  clucida_test(${name} ${ARGN})
  target_compile_definitions(${name} PRIVATE CLUCIDA_SCENES="${CMAKE_SOURCE_DIR}/scenes")
endfunction()

clucida_oracle_test(test_oracle test_oracle.cpp LIBS clucida_oracle fmt::fmt)
clucida_oracle_test(test_oracle_solids test_oracle_solids.cpp LIBS clucida_oracle fmt::fmt)
clucida_oracle_test(test_oracle_paths test_oracle_paths.cpp COST 10 LIBS clucida_oracle fmt::fmt)
clucida_oracle_test(test_oracle_kernels test_oracle_kernels.cpp LIBS clucida_oracle native_scene)
clucida_test(test_divergence test_divergence.cpp LIBS clucida_error)
clucida_test(test_measure_error test_measure_error.cpp COST 10 LIBS clucida_error)
clucida_test(test_plot test_plot.cpp LIBS clucida_speed)
clucida_test(test_rank_test test_rank_test.cpp LIBS clucida_speed)
clucida_test(test_speed test_speed.cpp COST 15 LIBS clucida_speed)
clucida_test(test_speed_axes test_speed_axes.cpp LIBS clucida_speed)
clucida_test(test_speed_rank test_speed_rank.cpp LIBS clucida_speed)
clucida_oracle_test(test_steps test_steps.cpp COST 40 LIBS clucida_error)
clucida_test(test_instruction_mix test_instruction_mix.cpp LIBS clucida_profile)
clucida_test(test_callgrind test_callgrind.cpp LIBS clucida_profile)
clucida_test(test_half_storage test_half_storage.cpp LIBS clucida_profile)

add_test(NAME test_bench_cli
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_bench_cli.py $<TARGET_FILE:clucida-bench>)
set_tests_properties(test_bench_cli PROPERTIES TIMEOUT 600 COST 40)

add_test(NAME test_profile_cli
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_profile_cli.py $<TARGET_FILE:clucida-bench>)
set_tests_properties(test_profile_cli PROPERTIES TIMEOUT 1200 COST 45)
add_test(NAME test_speed_cli
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_speed_cli.py $<TARGET_FILE:clucida-bench>
                 $<TARGET_FILE:clucida>)
set_tests_properties(test_speed_cli PROPERTIES TIMEOUT 900 COST 55)

add_test(NAME test_corpus COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_corpus.py
         $<TARGET_FILE:clucida> ${CMAKE_SOURCE_DIR}/bench)
set_tests_properties(test_corpus PROPERTIES TIMEOUT 300)

add_test(NAME test_memory COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_memory.py
         $<TARGET_FILE:clucida> ${CMAKE_SOURCE_DIR}/bench)
set_tests_properties(test_memory PROPERTIES TIMEOUT 300)

clucida_test(test_agreement test_agreement.cpp LIBS clucida_speed)
add_test(NAME test_agreement_cli
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_agreement.py $<TARGET_FILE:clucida-bench>)
set_tests_properties(test_agreement_cli PROPERTIES TIMEOUT 600)
