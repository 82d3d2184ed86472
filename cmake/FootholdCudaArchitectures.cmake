# Which GPUs CUDA code is compiled for where nobody says.

# The oldest that CUDA 13 knows. Its intermediate code (PTX) is in the program, too: the driver of a later GPU compiles it when the program first
# runs. docs/cuda.md has what finished code for all of them would cost.
set(FOOTHOLD_CUDA_ARCHITECTURES_OF_ANY_GPU 75)

# foothold_find_gpus(<VARIABLE>): the architectures of the GPUs in this machine that CUDA 13 has code for, each once.
function(foothold_find_gpus variable)
  set(architectures)
  execute_process(COMMAND nvidia-smi --query-gpu=compute_cap --format=csv,noheader OUTPUT_VARIABLE capabilities ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    string(REGEX MATCHALL "[0-9]+\\.[0-9]" capabilities "${capabilities}")
    foreach(capability ${capabilities})
      string(REPLACE "." "" architecture ${capability})
      if(architecture LESS 75)
        message(WARNING "This machine has a GPU of compute capability ${capability}, for which CUDA 13 has no code; expected 7.5 or later")
      else()
        list(APPEND architectures ${architecture})
      endif()
    endforeach()
    list(REMOVE_DUPLICATES architectures)
  endif()
  set(${variable} ${architectures} PARENT_SCOPE)
endfunction()
