# The Python package: its tests and its types. Of the interpreters here one that has pytest, hypothesis and mypy: the
# system's, whose packages scripts/setup installs, need not be the first on the PATH.
foreach(candidate ${Python3_EXECUTABLE} /usr/bin/python3)
  execute_process(COMMAND ${candidate} -c "import pytest, hypothesis, mypy, numpy"
                  RESULT_VARIABLE lacks OUTPUT_QUIET ERROR_QUIET)
  if(lacks EQUAL 0)
    set(python_with_pytest ${candidate})
    break()
  endif()
endforeach()
if(NOT python_with_pytest)
  message(FATAL_ERROR "The tests of the Python package need pytest, hypothesis, mypy and numpy: scripts/setup test")
endif()
add_test(NAME test_python COMMAND ${python_with_pytest} -m pytest -q -p no:cacheprovider ${CMAKE_CURRENT_SOURCE_DIR}/python
         WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(test_python PROPERTIES TIMEOUT 600 COST 20 ENVIRONMENT "CLUCIDA=$<TARGET_FILE:clucida>;PYTHONDONTWRITEBYTECODE=1")
add_test(NAME test_python_types COMMAND ${python_with_pytest} -m mypy --cache-dir ${CMAKE_CURRENT_BINARY_DIR}/mypy
         scene/python/clucida scene/python/examples tests/python WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
set_tests_properties(test_python_types PROPERTIES TIMEOUT 300)
