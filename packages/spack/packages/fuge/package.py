"""Recipe for Spack: ``spack repo add packages/spack``, ``spack dev-build fuge@0.1.0`` in the sources."""

from spack.package import *


class Fuge(CMakePackage):
    """Frictionless contact of elastic bodies: forces, gaps and the rigid approach, from an influence matrix or by
    fast Fourier transforms on half-planes and half-spaces, exactly and with a certificate."""

    license("BSD-3-Clause")

    version("0.1.0")

    variant("shared", default=True, description="Build shared libraries")
    variant("fftw", default=True, description="Half-planes and half-spaces by FFT (FFTW is under the GPL)")
    variant("sparse", default=True, description="Sparse stiffness matrices by CHOLMOD")
    variant("mpi", default=False, when="+fftw", description="Surfaces over MPI")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("lapack")
    depends_on("blas")
    depends_on("fftw@3.3.6: precision=float,double", when="+fftw")
    depends_on("suite-sparse", when="+sparse")
    depends_on("mpi", when="+mpi")

    def cmake_args(self):
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("FUGE_WITH_FFTW", "fftw"),
            self.define_from_variant("FUGE_SPARSE", "sparse"),
            self.define_from_variant("FUGE_MPI", "mpi"),
            self.define("FUGE_BUILD_TESTS", self.run_tests),
            self.define("FUGE_BUILD_EXAMPLES", self.run_tests),
        ]
