# Granulaw on Debian 12, for systems that are none. From the top folder, with podman or docker:
#     podman build -t granulaw .
#     podman run --rm --userns=keep-id -v "$PWD:/work" granulaw mpm --version
FROM debian:12 AS made
COPY . /src
WORKDIR /src
RUN tools/setup
RUN cmake --preset release -DGRANULAW_BUILD_TESTS=OFF -DGRANULAW_BUILD_BENCHMARKS=OFF && cmake --build --preset release --target package

FROM debian:12-slim
COPY --from=made /src/build/release/granulaw_*.deb /tmp/
RUN apt-get update && apt-get install -q -y --no-install-recommends /tmp/granulaw_*.deb python3-h5py python3-matplotlib python3-numpy && rm -rf /var/lib/apt/lists/*
# Results are not written as root. The home, for the cache of runs, serves any user that --user names.
RUN useradd --uid 1000 --create-home user && chmod 777 /home/user
ENV HOME=/home/user OMP_NUM_THREADS=1
USER user
WORKDIR /work
