# The host's tests: what needs no device, what needs one, and the program as its users meet it.
clucida_test(test_host_kernel_source test_host_kernel_source.cpp LIBS clucida_host)
clucida_test(test_build_log test_build_log.cpp LIBS clucida_host)
clucida_test(test_host_choice test_host_choice.cpp LIBS clucida_host)
clucida_test(test_host_files test_host_files.cpp LIBS clucida_host)
clucida_test(test_host_frames test_host_frames.cpp LIBS clucida_host)
clucida_test(test_quality_choice test_quality_choice.cpp LIBS clucida_host)
clucida_test(test_picture test_picture.cpp LIBS clucida_host)
clucida_test(test_flip test_flip.cpp LIBS clucida_host)
clucida_test(test_host_device test_host_device.cpp LIBS clucida_host)
clucida_test(test_trace test_trace.cpp COST 20 LIBS clucida_host)
clucida_test(test_frame_deal test_frame_deal.cpp LIBS clucida_host)

find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME test_cli COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_cli.py $<TARGET_FILE:clucida>)
set_tests_properties(test_cli PROPERTIES TIMEOUT 600 COST 30)
add_test(NAME test_sequence COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_sequence.py
         $<TARGET_FILE:clucida>)
set_tests_properties(test_sequence PROPERTIES TIMEOUT 600 COST 25)
# A real Slurm on loopback, and GNU parallel: half a minute.
add_test(NAME test_many_machines COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test_many_machines.py
         $<TARGET_FILE:clucida>)
set_tests_properties(test_many_machines PROPERTIES TIMEOUT 600 RUN_SERIAL TRUE)
