message(FATAL_ERROR "this build has the instructions of this machine's processor (SURGE_NATIVE): "
        "packages are made of cmake --preset portable")
