# Debian's arm-none-eabi-gcc for a Cortex-M4F, without a library of C.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
if(NOT DEFINED CMAKE_C_COMPILER)
  set(CMAKE_C_COMPILER arm-none-eabi-gcc)
endif()
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffreestanding -O2")
# There is nothing here that a program of the test could end in.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
