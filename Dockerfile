# The service and its guide. Build and run it with PostgreSQL: docker compose up --build
FROM python:3.11-slim-bookworm AS build

ENV PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1
WORKDIR /src
RUN python -m venv /opt/roadtalk
ENV PATH=/opt/roadtalk/bin:$PATH

# Dependencies come first: they change less often than the sources, so this layer stays in the cache.
COPY pyproject.toml README.md ./
# hadolint ignore=DL3013
RUN mkdir sim service web prompts \
    && touch sim/__init__.py service/__init__.py \
    && pip install --quiet '.[postgres,llm,video]' \
    && pip uninstall --quiet --yes roadtalk

COPY . .
# Sphinx builds the guide in an environment of its own, which is left behind.
RUN python -m venv --system-site-packages /opt/docs \
    && echo /opt/roadtalk/lib/python3.11/site-packages > /opt/docs/lib/python3.11/site-packages/roadtalk.pth \
    && /opt/docs/bin/pip install --quiet 'sphinx>=8.2' 'myst-parser>=4' 'furo>=2024.8.6' \
    && /opt/docs/bin/python -m sphinx -q -W --keep-going -b html -d /tmp/doctrees docs docs/site \
    && pip install --quiet --no-deps .

FROM python:3.11-slim-bookworm
RUN useradd --create-home --uid 10001 roadtalk && install -d -o roadtalk /data
COPY --from=build /opt/roadtalk /opt/roadtalk
ENV PATH=/opt/roadtalk/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    ROADTALK_HOST=0.0.0.0 \
    ROADTALK_DATABASE=sqlite:////data/roadtalk.db \
    ROADTALK_LOG_FORMAT=json
USER 10001
WORKDIR /data
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=3s --start-period=30s \
    CMD ["python", "-c", "import urllib.request as u; u.urlopen('http://127.0.0.1:8000/readyz', timeout=2)"]
# A service that listens beyond loopback needs ROADTALK_API_KEY.
CMD ["roadtalk", "serve"]
