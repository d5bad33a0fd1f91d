//! Choice of the instruction set at run time.

/// Instruction sets for which the kernels are compiled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Isa {
    #[cfg(target_arch = "x86_64")]
    Avx512,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg_attr(target_arch = "aarch64", allow(dead_code))]
    Plain,
    #[cfg(target_arch = "aarch64")]
    Neon,
}

/// The best instruction set of this machine.
pub(super) fn best() -> Isa {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("fma")
        {
            return Isa::Avx512;
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            return Isa::Avx2;
        }
        Isa::Plain
    }
    #[cfg(target_arch = "aarch64")]
    {
        Isa::Neon // part of the base instruction set, fused multiply-add included
    }
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    {
        Isa::Plain
    }
}

/// All instruction sets of this machine.
#[cfg(test)]
pub(super) fn available() -> Vec<Isa> {
    match best() {
        Isa::Plain => vec![Isa::Plain],
        #[cfg(target_arch = "x86_64")]
        Isa::Avx512 if is_x86_feature_detected!("avx2") => vec![Isa::Avx512, Isa::Avx2, Isa::Plain],
        best => vec![best, Isa::Plain],
    }
}

/// Compile `$generic::<FUSED>` for every instruction set and define `$name`, which takes the set.
macro_rules! for_every_isa {
    ($name:ident, $generic:ident, ($($arg:ident: $ty:ty),*) -> $out:ty) => {
        #[allow(unsafe_code)] // calling code built for an instruction set that was detected before
        fn $name(isa: $crate::kernel::dispatch::Isa, $($arg: $ty),*) -> $out {
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx512f,avx512dq,avx512vl,fma")]
            fn avx512($($arg: $ty),*) -> $out {
                $generic::<true>($($arg),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma")]
            fn avx2($($arg: $ty),*) -> $out {
                $generic::<true>($($arg),*)
            }
            match isa {
                // SAFETY: `Isa::Avx512` is made only where the processor reports these features.
                #[cfg(target_arch = "x86_64")]
                $crate::kernel::dispatch::Isa::Avx512 => unsafe { avx512($($arg),*) },
                // SAFETY: as above, for AVX2 and FMA.
                #[cfg(target_arch = "x86_64")]
                $crate::kernel::dispatch::Isa::Avx2 => unsafe { avx2($($arg),*) },
                #[cfg(target_arch = "aarch64")]
                $crate::kernel::dispatch::Isa::Neon => $generic::<true>($($arg),*),
                $crate::kernel::dispatch::Isa::Plain => $generic::<false>($($arg),*),
            }
        }
    };
}
pub(super) use for_every_isa;
